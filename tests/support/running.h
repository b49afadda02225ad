#pragma once

#include <functional>
#include <string>
#include <vector>

namespace offstage::test {

/// A program that runs beside the test. Killed with its test.
class Running {
public:
  explicit Running(const std::vector<std::string>& arguments);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  [[nodiscard]] int id() const { return child_; }
  void signal(int number) const;
  /// Waits so long for its end; whether it has ended.
  bool wait(int milliseconds);
  /// Waits until `condition` holds, for a minute at most; false when the program ended before.
  bool waitUntil(const std::function<bool()>& condition);
  /// Waits for its end; the exit status, 128 + signal when it was killed.
  int finish();
  /// Waits for its end and for that of everything it has started: they hold its standard error.
  void waitForAll();
  [[nodiscard]] const std::string& errors() const { return errors_; } ///< of standard error, after its end

private:
  int child_ = -1;
  int status_ = -1;
  int errorPipe_ = -1;
  bool ended_ = false;
  std::string errors_;
};

/// The processes that a process has started and that live.
std::vector<int> childrenOf(int process);

/// Whether there is a process of this number that has not ended (one that nobody has waited for has).
bool isRunning(int process);

} // namespace offstage::test
