#pragma once

#include "render/compare/report.h"

#include <string>
#include <vector>

namespace offstage {

// Pieces of JSON that writeJson and the HTML report share.

std::string jsonNumber(double value); ///< shortest that reads back the same; null when not finite
std::string jsonLines(const std::vector<std::string>& lines);
std::string jsonValue(const ReportNumber& number);
/// `, "key": value` for each number, to follow another member.
std::string jsonMembers(const std::vector<ReportNumber>& numbers);
std::string jsonCurves(const std::vector<ReportCurve>& curves);
std::string jsonWorst(const std::vector<PixelPair>& worst);

} // namespace offstage
