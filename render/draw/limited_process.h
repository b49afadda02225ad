#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// A program to be run on input that is not trusted.
struct LimitedProcess {
  std::filesystem::path program;        ///< its file; no shell and no search take part
  std::vector<std::string> arguments;   ///< without the program's name
  std::vector<std::string> environment; ///< "NAME=value"; nothing of this process's own is passed on
  std::filesystem::path directory;      ///< where it runs
  std::string output;                   ///< a new file there that takes what it prints; empty: nowhere
  std::chrono::seconds most{5};         ///< of processor time, and twice that of the wall clock
};

/// Why such a process ended: its exit status, or nothing when it was killed, by its limits (1 GiB of memory,
/// 64 MiB a file, `most`) or otherwise. Input is empty. All that it started is killed
/// with it. Throws Error(Transient) when the system allows no more processes.
std::optional<int> run(const LimitedProcess& process);

/// The file of a program by the folders of PATH; nothing when there is none.
std::optional<std::filesystem::path> findProgram(const std::string& name);

} // namespace offstage
