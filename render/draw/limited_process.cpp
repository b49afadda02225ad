#include "render/draw/limited_process.h"

#include "src/sim/error.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr rlim_t kMemory = 1UL << 30U; ///< bytes
constexpr rlim_t kFile = 64UL << 20U;  ///< bytes
constexpr rlim_t kOpenFiles = 64;
constexpr std::chrono::milliseconds kPoll{5};

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  list.reserve(texts.size() + 1);
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

void limit(__rlimit_resource resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* arguments, char* const* environment,
                         const char* directory, const char* output, rlim_t seconds) {
  setpgid(0, 0); // so that what it starts can be killed with it
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  limit(RLIMIT_AS, kMemory);
  limit(RLIMIT_FSIZE, kFile);
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, kOpenFiles);
  const int nothing = open("/dev/null", O_RDWR);
  if (nothing < 0 || chdir(directory) != 0) _exit(127);
  const int printed = *output == '\0' ? nothing : open(output, O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (printed < 0) _exit(127);
  dup2(nothing, STDIN_FILENO);
  dup2(printed, STDOUT_FILENO);
  dup2(printed, STDERR_FILENO);
  close_range(3, ~0U, 0);
  execve(program, arguments, environment);
  _exit(127);
}

} // namespace

std::optional<int> run(const LimitedProcess& process) {
  std::vector<std::string> arguments{process.program.string()};
  arguments.insert(arguments.end(), process.arguments.begin(), process.arguments.end());
  std::vector<std::string> environment = process.environment;
  const std::vector<char*> argv = pointers(arguments);
  const std::vector<char*> envp = pointers(environment);
  const pid_t child = fork();
  if (child < 0)
    throw Error(ExitCode::Transient,
                fmt::format("{} cannot be started: {}", process.program.string(), std::strerror(errno)));
  if (child == 0)
    become(process.program.c_str(), argv.data(), envp.data(), process.directory.c_str(),
           process.output.c_str(), static_cast<rlim_t>(process.most.count()));
  setpgid(child, child); // whichever of the two is first

  const auto deadline = std::chrono::steady_clock::now() + 2 * process.most;
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(kPoll);
  kill(-child, SIGKILL);
  if (ended == 0) waitpid(child, &status, 0);
  if (!WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

std::optional<std::filesystem::path> findProgram(const std::string& name) {
  const char* path = std::getenv("PATH"); // NOLINT(concurrency-mt-unsafe)
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path file = std::filesystem::path(folders.substr(0, end)) / name;
    std::error_code ignored;
    if (file.is_absolute() && std::filesystem::is_regular_file(file, ignored) &&
        access(file.c_str(), X_OK) == 0)
      return file;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return std::nullopt;
}

} // namespace offstage
