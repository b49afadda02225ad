#pragma once

#include "render/job/manifest.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// The folder OUT.parts beside an output: its finished chunks, a manifest of what they were made from, and a
/// lock that two runs on the same OUT cannot both hold.
class Parts {
public:
  enum class Use : std::uint8_t {
    Whole,   ///< a whole render: no other run may use the folder
    Segment, ///< a segment: other segments of the same render may run at the same time
  };

  /// Makes the folder, or takes over one that an earlier run left. Chunks of another manifest are removed,
  /// and so are all with `resume` = false. Throws Error(BadInput) when something else stands there (nothing
  /// of it is touched) or the folder cannot be made; Error(Transient) when another run uses it.
  Parts(const std::filesystem::path& out, const Manifest& manifest, Use use, bool resume);
  /// Removes the folder if it holds no chunk.
  ~Parts();
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  static std::filesystem::path folderFor(const std::filesystem::path& out);
  static std::filesystem::path manifestFor(const std::filesystem::path& out);

  [[nodiscard]] std::filesystem::path chunk(std::int64_t index) const;  ///< its packets or pictures
  [[nodiscard]] std::filesystem::path hashes(std::int64_t index) const; ///< its lines of `--hash`
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Why an earlier run's chunks could not be used; empty when there were none or they can.
  [[nodiscard]] const std::string& notice() const { return notice_; }

  void drop(std::int64_t index);  ///< removes a chunk that is not whole
  void removeTemporaries() const; ///< of workers that were killed; only with Use::Whole
  void letGo();                   ///< of the lock
  void removeAll();               ///< the folder and all that is in it

private:
  void lock(const Manifest& manifest);
  bool tryLock(int operation);
  void takeOver(const Manifest& manifest, bool resume);
  void requireOwn() const;
  void removeOwn() const; ///< all but the lock

  std::filesystem::path folder_;
  Use use_;
  int lock_ = -1;
  int owner_ = 0; ///< process
  std::string notice_;
};

} // namespace offstage
