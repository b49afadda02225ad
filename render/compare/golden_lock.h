#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace offstage {

/// What drew a golden: for people who wonder why another machine's pixels differ.
struct GoldenMachine {
  std::string renderer;  ///< GL_RENDERER
  std::string mesa;      ///< "22.3.6", from GL_VERSION; "-" where it does not say
  std::string llvm;      ///< "15.0.6", from GL_RENDERER; "-" where it does not say
  std::string processor; ///< "model name" of /proc/cpuinfo; "-" where there is none
  std::string version;   ///< of Offstage
};

/// This machine, drawing with the GL of these names.
GoldenMachine thisMachine(const std::string& renderer, const std::string& glVersion);

/// What is known of one golden beside its picture.
struct GoldenEntry {
  std::uint64_t state = 0;  ///< state hash of its frame
  std::uint64_t pixels = 0; ///< Frame::hash of the picture
  GoldenMachine machine;
};

/// `goldens.lock`: a line a golden, its cells separated by tabs, in the order of the names.
class GoldenLock {
public:
  /// An absent file is an empty lock. Throws SceneError, located, for a line that is none.
  static GoldenLock load(const std::filesystem::path& file);
  void save(const std::filesystem::path& file) const; ///< whole or not at all; throws as AtomicFile

  [[nodiscard]] const std::map<std::string, GoldenEntry>& entries() const { return entries_; }
  [[nodiscard]] const GoldenEntry* find(const std::string& name) const;
  /// Leaves the line as it is when state and pixels are the same, so that another machine changes nothing.
  void set(const std::string& name, const GoldenEntry& entry);
  void erase(const std::string& name) { entries_.erase(name); }

private:
  std::map<std::string, GoldenEntry> entries_;
};

} // namespace offstage
