#include "src/scene/toml_merge.h"

#include <algorithm>

namespace offstage {

const TomlEntry* findEntry(const TomlValue& table, std::string_view key) {
  const TomlValue::Table* entries = table.table();
  if (entries == nullptr) return nullptr;
  const auto found = std::ranges::find(*entries, key, &TomlEntry::key);
  return found == entries->end() ? nullptr : &*found;
}

void eraseEntry(TomlValue& table, std::string_view key) {
  auto* entries = std::get_if<TomlValue::Table>(&table.data);
  if (entries != nullptr) std::erase_if(*entries, [&](const TomlEntry& entry) { return entry.key == key; });
}

TomlValue merged(const TomlValue& base, const TomlValue& changes) {
  if (base.table() == nullptr || changes.table() == nullptr) return changes;
  TomlValue result = base;
  auto& entries = std::get<TomlValue::Table>(result.data);
  for (const TomlEntry& change : *changes.table()) {
    const auto found = std::ranges::find(entries, change.key, &TomlEntry::key);
    if (found == entries.end()) {
      entries.push_back(change);
    } else {
      TomlEntry entry = change; // an error in it is told where the change stands
      entry.value = merged(found->value, change.value);
      *found = std::move(entry);
    }
  }
  return result;
}

} // namespace offstage
