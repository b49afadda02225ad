#include "render/stage/stage.h"

#include "src/scene/palette.h"

#include <algorithm>
#include <utility>

namespace offstage {

void Stage::add(const Node& node) {
  if (contains(node)) return;
  entries_.push_back({node, nextId_++, kNoLook, 0});
}

void Stage::remove(const Node& node) {
  const auto entry = std::ranges::find(entries_, node, &Entry::node);
  if (entry == entries_.end()) return;
  if (entry->look != kNoLook) freeLooks_.push_back(entry->look);
  entries_.erase(entry);
}

BodySelection Stage::select(const Node& node) {
  add(node);
  overlaysChanged_ = true;
  return {false, {std::ranges::find(entries_, node, &Entry::node)->id}, {}};
}

void Stage::addTrail(const Node& node, TrailOverlay style) {
  style.of = select(node);
  overlays_.trails.push_back(std::move(style));
}

void Stage::addGhosts(const Node& node, GhostOverlay style) {
  style.of = select(node);
  overlays_.ghosts.push_back(std::move(style));
}

void Stage::addOutline(const Node& node, OutlineOverlay style) {
  style.of = select(node);
  if (!style.color) style.color = inkOn(settings_.background, 0.6);
  overlays_.outlines.push_back(std::move(style));
}

void Stage::addMark(const Node& node, MarkOverlay style) {
  style.of = select(node);
  if (!style.color) style.color = inkOn(settings_.background);
  overlays_.marks.push_back(std::move(style));
}

void Stage::addArrow(const Node& node, ArrowOverlay style) {
  style.of = select(node);
  overlays_.arrows.push_back(std::move(style));
}

void Stage::addGrid(GridOverlay style) {
  overlaysChanged_ = true;
  overlays_.grids.push_back(style);
}

bool Stage::contains(const Node& node) const {
  return std::ranges::find(entries_, node, &Entry::node) != entries_.end();
}

void Stage::add(const Text& text) {
  if (!contains(text)) texts_.push_back({text});
}

void Stage::remove(const Text& text) {
  std::erase_if(texts_, [&](const TextEntry& entry) { return entry.text == text; });
}

bool Stage::contains(const Text& text) const {
  return std::ranges::find(texts_, text, &TextEntry::text) != texts_.end();
}

} // namespace offstage
