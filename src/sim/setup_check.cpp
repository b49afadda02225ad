#include "src/sim/setup_check.h"

#include "src/sim/closed_form.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace offstage {
namespace {

void require(bool holds, const std::string& where, const std::string& what) {
  if (!holds) throw Error(ExitCode::BadInput, where + ": " + what);
}

bool isLength(double value) {
  return std::isfinite(value) && value >= 0.0;
}

void checkGroup(const WorldSetup& setup, std::uint32_t group, const std::string& where) {
  require(group < setup.groups.size(), where,
          "group " + std::to_string(group) + " does not exist; there are " +
              std::to_string(setup.groups.size()));
}

/// What bodies and the prototypes of spawners and launches have in common.
void checkBody(const WorldSetup& setup, const Body& body, const std::string& where) {
  checkGroup(setup, body.group, where);
  require(isLength(body.radius), where, "the radius must be finite and not negative");
  require(isLength(body.size.x()) && isLength(body.size.y()), where,
          "the size must be finite and not negative");
  require(std::isfinite(body.mass) && body.mass > 0.0, where, "the mass must be finite and above 0");
  require(body.restitution >= 0.0 && body.restitution <= 1.0, where, "the restitution must be from 0 to 1");
  require(isLength(body.friction), where, "the friction must be finite and not negative");
}

void checkPrototype(const WorldSetup& setup, const Body& prototype, const std::string& where) {
  checkBody(setup, prototype, where);
  if (prototype.integrator != Integrator::Exact) return;
  if (const auto problem = closedFormForceProblem(setup, prototype)) {
    require(false, where, "no closed form for the integrator exact: " + *problem);
  }
}

void checkForce(const WorldSetup& setup, const Force& force, const std::string& where) {
  if (force.group) checkGroup(setup, *force.group, where);
  struct Visitor {
    const std::string& where;
    void operator()(const DragForce& f) const {
      require(isLength(f.linear) && isLength(f.quadratic), where, "drag must be finite and not negative");
    }
    void operator()(const SpringForce& f) const {
      require(isLength(f.stiffness) && isLength(f.length) && isLength(f.damping), where,
              "a spring's stiffness, length and damping must be finite and not negative");
    }
    void operator()(const AttractForce& f) const {
      require(std::isfinite(f.strength) && isLength(f.softening), where,
              "an attraction's strength must be finite, its softening finite and not negative");
    }
    void operator()(const WindForce& f) const {
      require(isLength(f.coefficient), where, "a wind's coefficient must be finite and not negative");
    }
    void operator()(const CustomForce& f) const {
      require(static_cast<bool>(f.evaluate), where, "a custom force needs a function");
    }
  };
  std::visit(Visitor{where}, force.kind);
}

void checkNumber(const Number& number, const std::string& where) {
  const auto* integer = std::get_if<IntegerNumber>(&number);
  require(integer == nullptr || integer->bound > 0, where, "the bound of a random integer must be above 0");
}

void checkSpawner(const WorldSetup& setup, const Spawner& spawner, const std::string& where) {
  require(spawner.every > 0.0, where, "the time between two bodies must be above 0");
  require(!spawner.looks.empty(), where, "it needs at least one look");
  for (const Number* number : {&spawner.x, &spawner.y, &spawner.radius, &spawner.width, &spawner.height,
                               &spawner.vx, &spawner.vy, &spawner.ax, &spawner.ay, &spawner.mass}) {
    checkNumber(*number, where);
  }
  if (spawner.restitution) checkNumber(*spawner.restitution, where);
  if (spawner.friction) checkNumber(*spawner.friction, where);
  checkPrototype(setup, spawner.prototype, where);
}

void checkLaunch(const WorldSetup& setup, const Launch& launch, const std::string& where) {
  require(isLength(launch.speed), where, "the speed must be finite and not negative");
  for (const Launch::Moment& moment : launch.moments) {
    require(!moment.frame || *moment.frame >= 1, where, "its frame must be 1 or later");
  }
  checkPrototype(setup, launch.prototype, where);
}

template <typename Items, typename Check>
void checkEach(const Items& items, const char* kind, Check&& check) {
  std::size_t number = 0;
  for (const auto& item : items) check(item, std::string(kind) + " " + std::to_string(number++));
}

} // namespace

void checkSetup(const WorldSetup& setup) {
  require(isLength(setup.pane.x()) && isLength(setup.pane.y()), "pane",
          "its size must be finite and not negative");
  require(setup.substeps >= 1, "substeps", "there must be at least 1");
  require(setup.contactModel == ContactModel::Lecture || setup.walls.clamp, "walls",
          "the solver's walls always clamp");
  require(setup.iterations >= 1, "iterations", "there must be at least 1");
  checkEach(setup.forces, "force",
            [&](const Force& force, const std::string& where) { checkForce(setup, force, where); });
  checkEach(setup.bodies, "body",
            [&](const Body& body, const std::string& where) { checkBody(setup, body, where); });
  checkEach(setup.spawners, "spawner",
            [&](const Spawner& spawner, const std::string& where) { checkSpawner(setup, spawner, where); });
  checkEach(setup.launches, "launch",
            [&](const Launch& launch, const std::string& where) { checkLaunch(setup, launch, where); });
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  checkEach(setup.contacts, "contact rule", [&](const ContactRule& rule, const std::string& where) {
    checkGroup(setup, rule.groupA, where);
    checkGroup(setup, rule.groupB, where);
    require(rule.restitution >= 0.0 && rule.restitution <= 1.0, where, "the restitution must be from 0 to 1");
    require(setup.contactModel == ContactModel::Lecture || rule.response != Response::Bounce ||
                (rule.separate && rule.approachingOnly),
            where, "the solver's bounces always separate, and only those that approach");
    require(pairs.insert(std::minmax(rule.groupA, rule.groupB)).second, where,
            "there is a rule for these two groups already");
  });
}

} // namespace offstage
