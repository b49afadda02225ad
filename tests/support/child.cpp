#include "tests/support/child.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace offstage::test {

namespace {
constexpr int kThrew = 200;
constexpr uid_t kNobody = 65534;
} // namespace

int inChild(const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    int status = kThrew;
    try {
      status = body();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "in the child: %s\n", error.what());
    }
    _exit(status);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void becomeNobody() {
  if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) {
    throw std::system_error(errno, std::generic_category(), "setresuid");
  }
}

} // namespace offstage::test
