#include "tests/support/scene_text.h"

namespace offstage::test {

Scene sceneOf(std::string_view text, const SceneOverrides& overrides) {
  return parseScene(text, "scene.toml", overrides);
}

std::vector<std::string> errorsOf(std::string_view text, const SceneOverrides& overrides) {
  std::vector<std::string> errors;
  try {
    static_cast<void>(sceneOf(text, overrides));
  } catch (const SceneError& problems) {
    for (const Diagnostic& diagnostic : problems.diagnostics()) errors.push_back(diagnostic.text());
  }
  return errors;
}

std::string_view designScene() {
  // clang-format off
  return R"toml(title    = "Exercise 2, step 2"
duration = 20.0                 # s of simulated time; with a recorded clock: at most this long (default: the whole log)
seed     = 2022                 # java.util.Random

[frame]
size       = [640, 480]         # px; also the pane that walls and [[spawn]] refer to
background = "white"            # CSS name, #rgb, #rrggbb or #rrggbbaa
scale      = 1.0                # output pixels per scene pixel

[clock]
fps      = 60                   # fixed steps (default 60); or:
# recorded = "lecture.dt"       # a dt log beside the scene: variable steps, video timestamps follow it; exactly one of the two
substeps = 1

[world]
gravity    = [0.0, 9.8]         # px/s²
integrator = "semi-implicit-euler"  # explicit-euler | semi-implicit-euler | verlet | midpoint | rk4 | exact

[walls]                         # the pane's edges; the multiplier on the flipped velocity component; absent: open
bottom = 0.8                    # left, right, top, bottom, or all
clamp  = true                   # false: flip only, as the slide words it

[[body]]
name         = "ball"           # optional, unique
group        = "balls"          # default "bodies"
shape        = "circle"         # circle: center, radius; rectangle: position (upper left), size
center       = [320, 440]
radius       = 20
velocity     = [0, 0]
acceleration = [0, 0]           # its own, added to the world's gravity
gravity      = true             # false: ignores the world's gravity
mass         = 1.0
integrator   = "rk4"            # default: the world's; "exact" where a closed form exists
fixed        = false            # true: never moves, still collides
fill         = "black"          # or { image = "ball.png", anchor = [0, 0, 1, 1], proportional = true }
stroke       = { color = "black", width = 1.0, align = "centered" }   # inside, outside; default: none
opacity      = 1.0
leaving      = "keep"           # "remove": a body wholly outside the pane goes; a launch's default
# order of drawing is order of creation; colours floor: alpha 0.5 is 127/255

[[spawn]]                       # a body every so often; takes the keys of [[body]], any number may be random
every    = 1.0                  # s: at most one a frame, when floor(time/every) > the count
count    = "spawned"            # or "alive", the lecture's list size
when     = "before-update"      # or "after-update"
limit    = 100                  # optional
shape    = "circle"
x        = { int = 640 }        # nextInt(640)
y        = { int = 480 }
radius   = { int = 50 }
vx       = { spread = 120.0 }   # (nextDouble()*2.0 - 1.0)*120.0
vy       = { spread = 120.0 }   # also { uniform = [a, b] }: a + nextDouble()*(b - a); { gaussian = [mean, sd] }

[[launch]]                      # a projectile: constant speed towards a destination, gravity ignored
at     = [0.5, 1.0]             # s: in the step to the first frame whose time is not before it; or frame = [30, 60]: in the
                                # step to that frame; the projectile already moves in that step
from   = [40, 440]              # a point or a body's name
toward = [320, 120]             # a point or a body's name, read at launch; it flies on past it
speed  = 200.0
radius = 5
group  = "shots"

[[collide]]
between   = ["balls", "balls"]
response  = "bounce"            # bounce | remove | remove-immediately | slide | report
restitution = 1.0
separate  = true                # push an overlapping pair apart, half each
approaching_only = true         # respond only while approaching

[[force]]                       # drag | spring | attract | wind | expression; see scenes/README.md
type = "drag"
)toml";
  // clang-format on
}

} // namespace offstage::test
