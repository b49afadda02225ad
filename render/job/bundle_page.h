#pragma once

#include "render/output/tracks.h"

#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// The page's file, render/job/page/index.html: a text in which {{name}} stands for what bundlePage() puts
/// there.
extern const std::string_view kBundlePage;

/// What a bundle's page shows. Names are of files beside it.
struct BundleContents {
  std::string title;
  int width = 0, height = 0; ///< px of the video
  std::string mp4, webm, poster;
  std::vector<std::string> files; ///< all that it links to
  std::vector<Cue> captions;
  std::vector<Chapter> chapters;
};

/// A page that plays the video with its captions and chapters, from disk or from a server. It loads nothing
/// but the video and its poster.
std::string bundlePage(const BundleContents& contents);

/// A text as HTML shows it, also within an attribute's double quotes.
std::string htmlText(std::string_view text);

} // namespace offstage
