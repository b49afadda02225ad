#include "render/draw/scene_texts.h"

#include "render/draw/camera.h"
#include "render/draw/formula.h"
#include "src/sim/birth.h"
#include "src/sim/force_field.h"

#include <optional>
#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Every character that a live value may be written with.
constexpr std::string_view kNumberCharacters = "+-.0123456789efinE–INF";

/// What a text consists of, whatever its values are.
std::string charactersOf(const TextTemplate& text) {
  std::string all;
  for (const TextTemplate::Piece& piece : text.pieces) all += piece.text;
  return all;
}

/// Where on the pane an item's anchor is; nothing while the body that it belongs to is not there.
std::optional<Vec2> anchorPoint(const TextItem& item, const Vec2& pane, const Snapshot& snapshot,
                                const Viewport& home, const Viewport& camera) {
  if (item.place) {
    const double em = item.look.size;
    return Vec2(em + acrossOf(*item.place) * (pane.x() - 2.0 * em) + item.offset.x(),
                em + downOf(*item.place) * (pane.y() - 2.0 * em) + item.offset.y());
  }
  if (!item.at.body) return Vec2(item.at.point + item.offset);
  const Body* body = findBody(snapshot.bodies, *item.at.body);
  if (body == nullptr) return std::nullopt;
  return Vec2(shownAt(centre(*body, body->position), home, camera) + item.offset);
}

} // namespace

SceneTexts::SceneTexts(const Scene& scene, const Viewport& viewport)
    : pane_(scene.size[0], scene.size[1]), home_(viewport), painter_(viewport) {
  std::vector<Diagnostic> problems;
  const FormulaCache cache;
  for (const TextItem& text : scene.texts) {
    Item item{text, nullptr};
    try {
      if (!item.formula.empty()) {
        const double size = item.look.size * viewport.scale;
        item.mask = std::make_shared<const Mask>(typeset(item.formula, size, cache));
      } else {
        const bool live = item.text.live();
        painter_.require(item.look, charactersOf(item.text), !live);
        if (live) painter_.require(item.look, kNumberCharacters, false);
      }
      items_.push_back(std::move(item));
    } catch (const SceneError& error) {
      problems.insert(problems.end(), error.diagnostics().begin(), error.diagnostics().end());
    } catch (const Error& error) {
      if (error.code() != ExitCode::BadInput) throw;
      problems.push_back({text.where, fmt::format("'{}' in [[text]]: {}",
                                                  text.formula.empty() ? "text" : "formula", error.what())});
    }
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
}

void SceneTexts::draw(Picture& picture, const Snapshot& snapshot, double time, const Viewport& camera) const {
  for (const Item& item : items_) {
    const double share = shownShare(item, time);
    if (!(share > 0.0)) continue;
    const std::optional<Vec2> at = anchorPoint(item, pane_, snapshot, home_, camera);
    if (!at) continue;
    if (item.mask != nullptr) {
      painter_.draw(picture, item.mask, item.look, *at, share);
      continue;
    }
    painter_.draw(picture, item.text.text(snapshot), item.look, *at, share, item.at.body.has_value());
  }
}

} // namespace offstage
