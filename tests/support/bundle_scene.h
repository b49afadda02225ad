#pragma once

namespace offstage::test {

/// A scene of two seconds with all that a bundle holds: sections, captions and sound, and texts that a page
/// must escape.
inline constexpr const char* kBundleScene = R"(title = "A \"bundle\" <b>"
duration = 2
[frame]
size = [128, 96]
[clock]
fps = 30
[world]
gravity = [0, 200]
[walls]
all = 0.9
[[body]]
center = [64, 20]
radius = 10
fill = "#0072b2"
[[section]]
title = "Start"
start = 0
[[section]]
title = "</script>"
start = 1
[[caption]]
text = "falls & falls"
from = 0
to = 0.8
[[caption]]
text = "bounces"
from = 0.9
to = 2
[sound]
clicks = true
[poster]
at = 0.5
)";

} // namespace offstage::test
