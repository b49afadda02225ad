#pragma once

#include "render/draw/mask.h"

#include <filesystem>
#include <optional>
#include <string>

namespace offstage {

/// Typeset formulas on disk, known by their content, in $XDG_CACHE_HOME/offstage/formulas (or ~/.cache/…). An
/// entry holds all that it was made from, so a damaged or foreign one is seen and made anew. Entries appear
/// whole (written aside and renamed), so any number of processes may share the folder. Without a folder that
/// can be written nothing is kept.
class FormulaCache {
public:
  FormulaCache();
  explicit FormulaCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] std::optional<Mask> find(const std::string& content) const;
  void put(const std::string& content, const Mask& mask) const;

private:
  [[nodiscard]] std::filesystem::path fileOf(const std::string& content) const;

  std::filesystem::path folder_; ///< empty: none
};

} // namespace offstage
