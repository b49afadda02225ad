#pragma once

#include <string>
#include <vector>

namespace offstage {

/// One encoder of FFmpeg's libraries that a sink needs.
struct CodecStatus {
  std::string encoder; ///< FFmpeg's name, such as "libx264"
  std::string purpose; ///< the files it is for
  std::string package; ///< the Debian package that brings it
  bool present = false;
};

/// Every encoder that the sinks use, present or not.
std::vector<CodecStatus> codecStatus();

/// "libavcodec 59.37.100, libavformat 59.27.100, libavutil 57.28.100": the libraries that are loaded.
std::string libavVersions();

} // namespace offstage
