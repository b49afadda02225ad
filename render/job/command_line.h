#pragma once

#include "render/job/render_options.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace offstage {

/// Adds the options that replace keys of a scene: --fps --duration --dt --seed --scale.
void addSceneOptions(CLI::App& app, RenderOptions& options);

/// Adds --size.
void addSizeOption(CLI::App& app, RenderOptions& options);

/// Adds the options that say what is drawn: the above, --from --to --quality.
void addDrawingOptions(CLI::App& app, RenderOptions& options);

/// Adds --strict.
void addStrictOption(CLI::App& app, bool& strict);

/// Adds --jobs --progress.
void addWorkerOptions(CLI::App& app, RenderOptions& options);

/// Adds every option of `render`: -o, the above, --strict --poster --jobs --segment --no-resume
/// --progress --hash.
void addRenderOptions(CLI::App& app, RenderOptions& options);

/// Adds the options of `join`: -o, those of addDrawingOptions, --progress --hash.
void addJoinOptions(CLI::App& app, RenderOptions& options);

/// Reads what RenderOptions::drawingArguments has written. Throws Error(BadInput) for anything else.
RenderOptions parseRenderOptions(const std::vector<std::string>& arguments);

/// "2/4" as the second of four segments; throws Error(BadInput) unless 1 ≤ I ≤ N.
Segment parseSegment(const std::string& text);

/// "1920x1080" as width and height in px; throws Error(BadInput) on anything else.
std::array<int, 2> parseSize(const std::string& text);

/// Parses argv with `app` and runs `action`, turning whatever goes wrong into a message on stderr and an exit
/// status: bad usage 2, an Error its own code, exhausted memory 75.
int runCommandLine(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& action);

} // namespace offstage
