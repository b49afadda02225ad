#pragma once

#include "render/stage/input.h"
#include "render/stage/node.h"
#include "render/stage/text.h"
#include "src/scene/overlay.h"
#include "src/sim/clock.h"
#include "src/sim/random.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace offstage {

/// How an exercise runs where its command line says nothing else.
struct Settings {
  std::string title;                 ///< metadata of a video
  std::array<int, 2> size{640, 480}; ///< px: the pane
  Color background{255, 255, 255, 1.0};
  double fps = 60.0;      ///< frames (and calls of frame()) a second
  double duration = 10.0; ///< s
  std::int64_t seed = 0;  ///< of Stage::random()
};

/// What an exercise draws on: shapes in order of their adding, later ones on top.
class Stage {
public:
  Stage(const Settings& settings, std::int64_t seed) : settings_(settings), random_(seed) {}

  [[nodiscard]] double width() const { return settings_.size[0]; }  ///< px
  [[nodiscard]] double height() const { return settings_.size[1]; } ///< px
  [[nodiscard]] double time() const { return now_.time; }           ///< s since the start
  [[nodiscard]] std::int64_t frame() const { return now_.frame; } ///< number of the frame being made, from 0
  [[nodiscard]] Random& random() { return random_; }              ///< java.util.Random, seeded

  /// What the user of a recorded game does (`--input`).
  [[nodiscard]] const Input& input() const { return input_; }

  /// Puts a shape on top. One that is there already stays where it is.
  void add(const Node& node);
  /// Takes a shape away; nothing happens when it is not there.
  void remove(const Node& node);
  [[nodiscard]] bool contains(const Node& node) const;
  [[nodiscard]] std::size_t count() const { return entries_.size(); } ///< shapes on the stage

  // What is drawn over and under shapes, as scene files have it (scenes/README.md, Overlays). Each is for one
  // shape, which it puts on the stage if need be, for as long as that stays; `style.of` is set here. Arrows
  // show the velocity and the acceleration of a GameObject.
  void addTrail(const Node& node, TrailOverlay style = {});
  void addGhosts(const Node& node, GhostOverlay style = {});
  void addOutline(const Node& node, OutlineOverlay style = {});
  void addMark(const Node& node, MarkOverlay style = {});
  void addArrow(const Node& node, ArrowOverlay style = {});
  /// Lines at multiples of `style.step` px from the upper-left corner, which are axes.
  void addGrid(GridOverlay style);
  // The same for texts, which lie over all shapes.
  void add(const Text& text);
  void remove(const Text& text);
  [[nodiscard]] bool contains(const Text& text) const;

private:
  friend class StageSource;
  struct Entry {
    Node node;
    std::uint32_t id; ///< number in order of adding, from 0
    std::uint32_t look;
    std::uint64_t lookVersion;
  };
  static constexpr std::uint32_t kNoLook = 0xffffffffU;

  BodySelection select(const Node& node);

  Settings settings_;
  Random random_;
  Tick now_;
  Input input_;
  std::vector<Entry> entries_;
  struct TextEntry {
    Text text;
    std::uint64_t checked = 0; ///< the version that was held against its font
  };
  std::vector<TextEntry> texts_;
  std::vector<std::uint32_t> freeLooks_; ///< of shapes that were removed, to be used again
  std::uint32_t nextId_ = 0;
  Overlays overlays_;
  bool overlaysChanged_ = false;
};

} // namespace offstage
