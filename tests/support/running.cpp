#include "tests/support/running.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace offstage::test {

Running::Running(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2");
  errorPipe_ = ends[0];
  child_ = fork();
  if (child_ < 0) throw std::runtime_error("fork");
  if (child_ == 0) {
    // As in process.cpp: what runs the tests may ignore them.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  close(ends[1]);
}

Running::~Running() {
  if (!ended_) {
    kill(child_, SIGKILL);
    finish();
  }
  close(errorPipe_);
}

void Running::signal(int number) const {
  kill(child_, number);
}

bool Running::wait(int milliseconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  while (!ended_) {
    int status = 0;
    if (waitpid(child_, &status, WNOHANG) == child_) {
      ended_ = true;
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    } else if (std::chrono::steady_clock::now() >= end) {
      return false;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return true;
}

bool Running::waitUntil(const std::function<bool()>& condition) {
  for (int i = 0; i < 60000; ++i) {
    if (condition()) return true;
    if (wait(1)) return false;
  }
  return false;
}

int Running::finish() {
  waitForAll();
  wait(60000);
  return status_;
}

void Running::waitForAll() {
  std::array<char, 4096> buffer{};
  ssize_t count = 0;
  while ((count = read(errorPipe_, buffer.data(), buffer.size())) > 0 || (count < 0 && errno == EINTR))
    if (count > 0) errors_.append(buffer.data(), static_cast<std::size_t>(count));
  wait(60000);
}

std::vector<int> childrenOf(int process) {
  std::vector<int> children;
  std::error_code error;
  const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (std::filesystem::directory_iterator task(tasks, error), end; !error && task != end;
       task.increment(error)) {
    std::ifstream file(task->path() / "children");
    for (int child = 0; file >> child;) children.push_back(child);
  }
  return children;
}

bool isRunning(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("State:"))
      return line.find('Z') == std::string::npos && line.find('X') == std::string::npos;
  return false;
}

} // namespace offstage::test
