#include "render/stage/stage.h"

#include <algorithm>

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
