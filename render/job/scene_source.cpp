#include "render/job/scene_source.h"

#include "render/draw/scene_glyphs.h"
#include "render/job/fingerprint.h"
#include "render/job/scene_tracks.h"

#include <algorithm>

namespace offstage {
namespace {

/// Of what is not pointed at, under a dimming pause.
constexpr double kDimmed = 0.55;
/// s: how long pointing at something takes to come and to go.
constexpr double kHighlightFade = 0.2;
/// s: how long a title card takes to come and to go.
constexpr double kCardFade = 0.3;
/// A ring's width, and its distance from what it is around, as a share of the pane's height.
constexpr double kRingWidth = 1.0 / 120.0;

std::variant<World, ReplayMotion> motionOf(const Scene& scene) {
  if (scene.replay) return ReplayMotion(scene.replay);
  return World(scene.world);
}

void addPaint(Fingerprint& fingerprint, const Paint& paint) {
  if (const auto* pattern = std::get_if<ImagePattern>(&paint)) fingerprint.addFile(pattern->file);
}

std::uint64_t fingerprintOf(const Scene& scene, const Film& film) {
  Fingerprint fingerprint;
  fingerprint.add(scene.text);
  fingerprint.add(scene.clock);
  for (const Look& look : scene.looks) {
    if (look.fill) addPaint(fingerprint, *look.fill);
    if (look.stroke) addPaint(fingerprint, look.stroke->paint);
  }
  for (const TextItem& item : scene.texts) fingerprint.addFile(fontFile(item.look.font));
  for (const auto& file : scene.files) fingerprint.addFile(file);
  if (scene.replay) fingerprint.addFile(scene.replay->trace.file);
  for (const Film::Voice& voice : film.voices) fingerprint.addFile(voice.sound.file);
  return fingerprint.value();
}

Vec2 centerOf(const Body& body) {
  return body.shape == Shape::Circle ? body.position : Vec2(body.position + body.size * 0.5);
}

bool isOneOf(const Body& body, const std::vector<std::uint32_t>& ids) {
  return std::ranges::count(ids, body.id) > 0;
}

Rgba8 veilOf(const Color& color, double opacity) {
  return {color.red, color.green, color.blue, color.alphaByte(opacity)};
}

/// A veil over an opaque colour.
Rgba8 mixed(const Rgba8& under, const Rgba8& veil) {
  const auto channel = [&veil](int low, int high) {
    return static_cast<std::uint8_t>((low * (255 - veil.a) + high * veil.a + 127) / 255);
  };
  return {channel(under.r, veil.r), channel(under.g, veil.g), channel(under.b, veil.b), 255};
}

/// How much of something that lasts from … to is there at `time`, when it comes and goes within `fade`; 0
/// … 1.
double presence(double time, double from, double to, double fade) {
  return std::clamp(std::min(time - from, to - time) / fade, 0.0, 1.0);
}

} // namespace

SceneSource::SceneSource(const Scene& scene, const Viewport& viewport)
    : clock_(scene.clock),
      title_(scene.title),
      motion_(motionOf(scene)),
      home_(viewport),
      painter_(viewport, scene.background),
      history_(scene.overlays),
      overlays_(scene.overlays, scene.world),
      textPainter_(viewport),
      plots_(scene, viewport, textPainter_),
      texts_(scene, viewport),
      card_(scene, viewport),
      timeline_(scene.timeline),
      film_(makeFilm(timeline_, clock_, narrationLengths(timeline_), title_)),
      camera_(film_.camera, Vec2(scene.size[0], scene.size[1])),
      ringWidth_(kRingWidth * scene.size[1]),
      fingerprint_(fingerprintOf(scene, film_)) {
  requireGlyphs(scene, textPainter_);
  // The painter numbers looks as the scene does, so Body::look needs no translation.
  for (const Look& look : scene.looks) painter_.addLook(look);
  ringLook_ = static_cast<std::uint32_t>(scene.looks.size());
  for (const Pause& pause : timeline_.pauses) {
    Look ring;
    ring.fill.reset();
    ring.stroke = Stroke{pause.color, ringWidth_, StrokeAlign::Outside};
    painter_.addLook(ring);
  }
  if (needsEvents(timeline_) && std::holds_alternative<World>(motion_)) start_ = std::get<World>(motion_);
  for (const std::uint32_t body : camera_.followed()) followed_.emplace(body, Vec2(Vec2::Zero()));
  if (!scene.panels.panels.empty()) {
    panels_ = std::make_unique<PanelSet>(scene, painter_.viewport());
    Fingerprint both;
    both.add(static_cast<std::int64_t>(fingerprint_));
    both.add(static_cast<std::int64_t>(panels_->fingerprint()));
    fingerprint_ = both.value();
  }
  note();
}

std::int64_t SceneSource::frame() const {
  return std::visit([](const auto& motion) { return motion.frame(); }, motion_);
}

void SceneSource::watch(const Scene& scene, WarningLog& log, const std::string& panel) {
  if (panels_ != nullptr) {
    panels_->watch(scene, log); // motion_ is not drawn
  } else if (const auto* world = std::get_if<World>(&motion_)) {
    watched_.emplace(*world, WarningText(scene, panel), log);
  }
}

void SceneSource::step() {
  const Tick tick = clock_.tick(frame() + 1);
  if (watched_)
    watched_->step(std::get<World>(motion_), tick);
  else
    std::visit([&tick](auto& motion) { motion.step(tick); }, motion_);
  if (panels_ != nullptr) panels_->stepTo(clock_.time(frame()));
  note();
}

void SceneSource::note() {
  const auto* world = std::get_if<World>(&motion_);
  interpolates_ = world != nullptr && world->setup().stepping.form == Stepping::Form::Accumulator;
  if (interpolates_) static_cast<void>(world->shown(interpolated_));
  history_.note(time(), frameBodies(), world != nullptr ? world->events() : std::span<const Event>());
  if (followed_.empty()) return;
  for (const Body& body : frameBodies())
    if (const auto place = followed_.find(body.id); place != followed_.end()) place->second = centerOf(body);
}

void SceneSource::show(const Shot& shot) {
  const auto& [wanted, fraction] = shot.moment;
  while (frame() < wanted) step();
  if (fraction > 0.0 && earlier_.frame != wanted) {
    earlier_ = {wanted, {frameBodies().begin(), frameBodies().end()}, stateHash()};
    step();
  }
  shot_ = shot;
  followsShots_ = true;
  if (fraction > 0.0) blend(fraction);
  if (!camera_.moves()) return;
  painter_.setViewport(camera_.at(shot.time, home_, [this](std::uint32_t id) {
    const auto shown = std::ranges::find(shownBodies(), id, &Body::id);
    return shown == shownBodies().end() ? followed_.at(id) : centerOf(*shown);
  }));
}

void SceneSource::blend(double fraction) {
  blended_ = earlier_.bodies;
  const std::span<const Body> later = frameBodies();
  auto next = later.begin();
  for (Body& body : blended_) { // both are in order of creation
    while (next != later.end() && next->id < body.id) ++next;
    if (next != later.end() && next->id == body.id)
      body.position += (next->position - body.position) * fraction;
  }
}

std::span<const Body> SceneSource::shownBodies() const {
  if (shot_.moment.fraction > 0.0) return blended_;
  return frameBodies();
}

std::span<const Body> SceneSource::frameBodies() const {
  return interpolates_ ? std::span<const Body>(interpolated_) : bodies();
}

double SceneSource::videoTime() const {
  return followsShots_ ? shot_.time : time();
}

std::uint64_t SceneSource::shownStateHash() const {
  return shot_.moment.fraction > 0.0 ? earlier_.stateHash : stateHash();
}

bool SceneSource::followsVideoTime() const {
  return camera_.moves() || timeline_.fadeIn > 0.0 || timeline_.fadeOut > 0.0 || !film_.freezes.empty() ||
         !film_.cards.empty() || !texts_.empty();
}

bool SceneSource::hasCaptions() const {
  return !timeline_.captions.empty() || !timeline_.eventCaptions.empty();
}

VideoTracks SceneSource::tracks(double from, double to) const {
  return sceneTracks(timeline_, film_, start_ ? &*start_ : nullptr, from, to);
}

void SceneSource::draw(Picture& picture) const {
  painter_.begin(picture);
  paint(picture);
  drawCard(picture);
  drawFade(picture);
}

void SceneSource::paint(Picture& picture) const {
  const Snapshot now = snapshot();
  if (panels_ != nullptr) {
    panels_->draw(picture);
    plots_.draw(picture, panels_->frames());
    texts_.draw(picture, now, videoTime(), painter_.viewport());
    return;
  }
  const Film::Freeze* freeze = presentFreeze();
  const OverlayPainter::Now overlaid{now.time, now.bodies, history_, painter_, textPainter_};
  overlays_.paint(picture, OverlayLayer::Behind, overlaid);
  drawBodies(picture, freeze);
  overlays_.paint(picture, OverlayLayer::Front, overlaid);
  if (freeze != nullptr && pauseOf(*freeze).highlight == Highlight::Dim)
    drawOverVeil(picture, *freeze, overlaid);
  plots_.draw(picture, {&now.frame, 1}, shot_.moment.fraction);
  texts_.draw(picture, now, videoTime(), painter_.viewport());
}

void SceneSource::keepMoment() {
  if (panels_ != nullptr) panels_->keepMoment();
  for (const Body& body : shownBodies()) {
    const auto [place, isNew] = keptAt_.try_emplace(body.id, body.position);
    if (!isNew && place->second == body.position) continue;
    place->second = body.position;
    kept_.push_back(body);
  }
}

const Film::Freeze* SceneSource::presentFreeze() const {
  const double now = videoTime();
  const auto freeze = std::ranges::find_if(
      film_.freezes, [now](const Film::Freeze& some) { return some.from <= now && now < some.to; });
  return freeze == film_.freezes.end() ? nullptr : &*freeze;
}

const Pause& SceneSource::pauseOf(const Film::Freeze& freeze) const {
  return timeline_.pauses[freeze.pause];
}

std::span<const Body> SceneSource::drawnBodies() const {
  return kept_.empty() ? shownBodies() : std::span<const Body>(kept_);
}

void SceneSource::drawBodies(Picture& picture, const Film::Freeze* freeze) const {
  const Pause* pause = freeze == nullptr ? nullptr : &pauseOf(*freeze);
  const bool dim = pause != nullptr && pause->highlight == Highlight::Dim;
  for (const Body& body : drawnBodies())
    if (!dim || !isOneOf(body, pause->bodies)) painter_.body(picture, body, body.look);
  if (pause == nullptr || dim) return;
  for (const Body& body : drawnBodies()) {
    if (!isOneOf(body, pause->bodies)) continue;
    const double radius = body.shape == Shape::Circle ? body.radius : body.size.norm() * 0.5;
    painter_.circle(picture, centerOf(body), radius + ringWidth_,
                    ringLook_ + static_cast<std::uint32_t>(freeze->pause));
  }
}

/// Darkens all that is painted, and paints what is pointed at over it, with what lies over it.
void SceneSource::drawOverVeil(Picture& picture, const Film::Freeze& freeze,
                               const OverlayPainter::Now& overlaid) const {
  painter_.veil(picture,
                veilOf(Color{}, kDimmed * presence(videoTime(), freeze.from, freeze.to, kHighlightFade)));
  const std::vector<std::uint32_t>& meant = pauseOf(freeze).bodies;
  for (const Body& body : drawnBodies())
    if (isOneOf(body, meant)) painter_.body(picture, body, body.look);
  if (!meant.empty()) overlays_.paintOf(picture, meant, overlaid);
}

void SceneSource::drawCard(Picture& picture) const {
  for (const Film::Card& card : film_.cards) {
    if (shot_.time < card.from || shot_.time >= card.to) continue;
    const double share =
        presence(shot_.time, card.from, card.to, std::min(kCardFade, (card.to - card.from) * 0.25));
    // At the video's very beginning there is nothing that a card could come out of.
    card_.draw(picture, card.title, card.subtitle,
               card.from == 0.0 && shot_.time < card.to - kCardFade ? 1.0 : share);
  }
}

/// The fades are over the pane; where the pane does not fill the picture, the background around it fades with
/// it.
void SceneSource::drawFade(Picture& picture) const {
  double opacity = 0.0;
  if (shot_.time < timeline_.fadeIn) opacity = 1.0 - shot_.time / timeline_.fadeIn;
  const double left = film_.seconds - shot_.time;
  if (left < timeline_.fadeOut) opacity = std::max(opacity, 1.0 - left / timeline_.fadeOut);
  const Rgba8 veil = veilOf(timeline_.fadeColor, opacity);
  if (veil.a == 0) return;
  painter_.veil(picture, veil);
  const PixelRect whole{0, 0, home_.width, home_.height};
  if (home_.clip == whole || picture.background.a != 255) return;
  // The pane keeps its background under the veil; around it, where nothing is painted, the picture's takes
  // the fade.
  painter_.ground(picture, picture.background);
  picture.background = mixed(picture.background, veil);
}

std::uint64_t SceneSource::stateHash() const {
  if (panels_ != nullptr) return panels_->stateHash();
  return std::visit([](const auto& motion) { return motion.stateHash(); }, motion_);
}

double SceneSource::time() const {
  return std::visit([](const auto& motion) { return motion.time(); }, motion_);
}

Snapshot SceneSource::snapshot() const {
  Snapshot snapshot; // a trace has no gravity and no forces
  if (const auto* world = std::get_if<World>(&motion_)) snapshot = snapshotOf(*world);
  const auto& [shown, fraction] = shot_.moment;
  snapshot.frame = fraction > 0.0 ? shown : frame();
  snapshot.time = fraction > 0.0 ? clock_.time(shown) + fraction * (time() - clock_.time(shown)) : time();
  snapshot.bodies = shownBodies();
  return snapshot;
}

std::span<const Body> SceneSource::bodies() const {
  return std::visit([](const auto& motion) { return motion.bodies(); }, motion_);
}

} // namespace offstage
