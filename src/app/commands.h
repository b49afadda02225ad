#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace offstage {

/// What a verb does once its command line is parsed; the exit status.
using Action = std::function<int()>;

/// Each adds one verb with its options to `app`; when that verb is called, `action` is set to what it does.
void addRender(CLI::App& app, Action& action);
void addJoin(CLI::App& app, Action& action);
void addStill(CLI::App& app, Action& action);
void addBundle(CLI::App& app, Action& action);
void addTrace(CLI::App& app, Action& action);
void addDiff(CLI::App& app, Action& action);
void addGolden(CLI::App& app, Action& action);
void addCheck(CLI::App& app, Action& action);
void addDoctor(CLI::App& app, Action& action);

} // namespace offstage
