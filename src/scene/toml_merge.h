#pragma once

#include "src/scene/toml_value.h"

namespace offstage {

/// `base` with what `changes` says otherwise: a table is merged key by key, anything else (an array of tables
/// included) takes the place of what was there. Values keep the places in the file where they stand.
TomlValue merged(const TomlValue& base, const TomlValue& changes);

/// A table's entry of this name, or null.
const TomlEntry* findEntry(const TomlValue& table, std::string_view key);
/// Takes an entry out of a table, if it is there.
void eraseEntry(TomlValue& table, std::string_view key);

} // namespace offstage
