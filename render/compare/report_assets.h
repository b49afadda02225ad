#pragma once

#include <string_view>

namespace offstage {

/// The files of render/compare/report, built in so that a report needs nothing beside the program.
extern const std::string_view kReportPage;   ///< index.html with @TITLE@ and @DATA@
extern const std::string_view kReportStyle;  ///< report.css
extern const std::string_view kReportScript; ///< report.js

} // namespace offstage
