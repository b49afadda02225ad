#pragma once

#include "src/sim/error.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {

/// Adds an option that holds one number from low to high. CLI11's own conversion takes "1e999", "nan" and
/// trailing text in some versions; numbers here are finite and whole words. Anything else is Error(BadInput).
template <class T>
CLI::Option* addNumber(CLI::App& app, const char* name, std::optional<T>& target, const char* type,
                       const char* help, T low = std::numeric_limits<T>::lowest(),
                       T high = std::numeric_limits<T>::max()) {
  return app
      .add_option_function<std::string>(
          name,
          [&target, name, low, high](const std::string& text) {
            T value{};
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            bool good = error == std::errc{} && end == text.data() + text.size();
            if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
            if (error == std::errc::result_out_of_range && std::is_integral_v<T>)
              throw Error(ExitCode::BadInput,
                          fmt::format("{} '{}' is not from {} to {}", name, text, low, high));
            if (!good)
              throw Error(ExitCode::BadInput,
                          fmt::format("{} '{}' is not {}", name, text,
                                      std::is_integral_v<T> ? "a whole number" : "a finite number"));
            if (value < low || value > high)
              throw Error(ExitCode::BadInput,
                          high == std::numeric_limits<T>::max()
                              ? fmt::format("{} '{}' is less than {}", name, text, low)
                              : fmt::format("{} '{}' is not from {} to {}", name, text, low, high));
            target = value;
          },
          help)
      ->type_name(type);
}

} // namespace offstage
