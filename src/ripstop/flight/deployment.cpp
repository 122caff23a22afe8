#include "ripstop/flight/deployment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"

namespace ripstop::inline flight {
namespace {

constexpr double longest_step = 1e-4;     // [s]
constexpr double steps_a_radian = 50;     // of the fastest oscillation of the lines
constexpr double same_place = 1e-12;      // [m]
constexpr double edge_out = 1e-5;         // of the canopy, that is out when its lines come taut
constexpr double between_rows = 2e-4;     // [s]
constexpr double longest_unreeling = 60;  // [s]
constexpr double longest_stretch = 3;     // [s]

/// The payload, the skirt or the cloth that has left the bag, and the bag.
enum Body { payload, skirt, bag, bodies };

struct Motion {
  std::array<double, bodies> x{}, v{};  // [m], [m/s]
  Motion moved(const Motion& rate, double h) const {
    Motion next = *this;
    for (int i = 0; i < bodies; ++i) next.x[i] += h * rate.x[i], next.v[i] += h * rate.v[i];
    return next;
  }
};

/// Lines or canopy in their container: the mass of the first `s` metres that leave it.
struct Stored {
  double length = 0;
  std::function<double(double)> mass;
  double per_length(double s) const {
    const double h = 1e-6 * length;
    const double low = std::max(0.0, s - h), high = std::min(length, s + h);
    return (mass(high) - mass(low)) / (high - low);
  }
};

class Deployer {
 public:
  explicit Deployer(const PackedParachute& packed);
  Deployment run();

 private:
  void begin(const char* phase);
  void record(double tension, bool always);
  double drag(double area, double v) const { return 0.5 * packed_.density * area * std::abs(v) * v; }
  double acceleration(double force, double mass) const {
    return std::isinf(mass) ? 0 : force / mass + packed_.gravity;
  }
  Motion step(const Motion& from, double h, const std::function<Motion(const Motion&)>& rate) const;

  bool unreel(const Stored& stored, double resistance, bool from_bag, double leading, double trailing,
              double trailing_area, const char* what);
  std::pair<double, double> skirt_and_bag(double out) const;
  double emerged(const Motion& m) const;
  Motion stretch_rate(const Motion& m);
  double stretch_step() const;
  bool may_slip(double h) const;
  void stretch();

  PackedParachute packed_;
  TensionCurve curve_;
  Stored lines_, canopy_;
  double time_ = 0, recorded_ = -1;
  double apart_ = 0;                     // of payload and bag where the container was empty [m]
  double out_ = 0;                       // canopy outside of the bag [m]
  double tension_ = 0;                   // of the lines [N]
  double stiffest_ = curve_.steepest();  // [N/m]
  bool stuck_ = true;                    // skirt and bag move as one
  Motion now_;
  Deployment result_;
};

Deployer::Deployer(const PackedParachute& packed) : packed_(packed), curve_(tension_curve(packed.lines)) {
  for (const SnatchPart& part : packed.lines) lines_.length += part.length;
  const double per_length = packed.lines_mass / lines_.length;
  lines_ = {lines_.length, [per_length](double s) { return per_length * s; }};
  canopy_ = {packed.canopy_length, [p = packed](double s) {
               return emerged_mass(p.canopy_mass, p.canopy_length, s, p.lines_first);
             }};
  now_.v = {packed.speed, packed.speed - packed.relative_speed, packed.speed - packed.relative_speed};
}

void Deployer::begin(const char* phase) {
  result_.phases.push_back({phase, time_, now_.x[payload], now_.v[payload], now_.v[bag]});
}

void Deployer::record(double tension, bool always) {
  if (tension > result_.snatch_load) result_.snatch_load = tension, result_.snatch_time = time_;
  if (!always && time_ - recorded_ < between_rows) return;
  recorded_ = time_;
  result_.rows.push_back(
      {time_, now_.x[payload], now_.v[payload], now_.v[bag], now_.x[payload] - now_.x[bag], out_, tension});
}

// Runge and Kutta's method of fourth order.
Motion Deployer::step(const Motion& from, double h, const std::function<Motion(const Motion&)>& rate) const {
  const Motion a = rate(from), b = rate(from.moved(a, h / 2)), c = rate(from.moved(b, h / 2)),
               d = rate(from.moved(c, h));
  return from.moved(a, h / 6).moved(b, h / 3).moved(c, h / 3).moved(d, h / 6);
}

// Two bodies, the payload and the bag, each with drag D; u is the speed at which they come apart, mu the mass per
// length of the part that leaves its container, F its resistance.
//   stored in the bag:        m_p v_p' = -D_p - F - mu u^2,   m_b v_b' = -D_b + F
//   stored with the payload:  m_p v_p' = -D_p - F,            m_b v_b' = -D_b + F + mu u^2
bool Deployer::unreel(const Stored& stored, double resistance, bool from_bag, double leading, double trailing,
                      double trailing_area, const char* what) {
  const double start = time_;
  double most = 0, tension = 0;
  const auto apart = [&](const Motion& m) { return m.x[payload] - m.x[bag] - apart_; };
  const auto masses = [&](double s) {
    const double out = stored.mass(s), in = stored.mass(stored.length) - out;
    return std::pair{leading + (from_bag ? out : in), trailing + (from_bag ? in : out)};
  };
  const auto rate = [&](const Motion& m) {
    const double s = std::clamp(apart(m), 0.0, stored.length), u = m.v[payload] - m.v[bag];
    const auto [mp, mb] = masses(s);
    const double dp = drag(packed_.payload_drag_area, m.v[payload]), db = drag(trailing_area, m.v[bag]);
    double pull = 0, impact = 0;
    if (apart(m) >= most - same_place && u > 0) {
      pull = resistance, impact = stored.per_length(s) * u * u;
    } else if (apart(m) >=
               most - same_place) {  // static: whatever keeps the bodies together, up to the resistance
      pull = std::clamp(std::isinf(mp) ? db : (db * mp - dp * mb) / (mp + mb), 0.0, resistance);
    }
    tension = pull + (from_bag ? impact : 0);
    Motion d;
    d.x = m.v;
    d.v[payload] = acceleration(-dp - pull - (from_bag ? impact : 0), mp);
    d.v[bag] = d.v[skirt] = acceleration(-db + pull + (from_bag ? 0 : impact), mb);
    return d;
  };
  while (time_ - start < longest_unreeling) {
    double h = longest_step;
    Motion next = step(now_, h, rate);
    const bool empty = apart(next) >= stored.length;
    if (empty) {
      double low = 0, high = h;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (apart(step(now_, middle, rate)) < stored.length ? low : high) = middle;
      }
      h = high, next = step(now_, h, rate);
    }
    now_ = next, time_ += h;
    if (now_.v[bag] > now_.v[payload] && apart(now_) > most) {  // the stows stop the bag
      const auto [mp, mb] = masses(apart(now_));
      now_.v[payload] =
          std::isinf(mp) ? now_.v[payload] : (mp * now_.v[payload] + mb * now_.v[bag]) / (mp + mb);
      now_.v[bag] = now_.v[skirt] = now_.v[payload];
    }
    most = std::max(most, apart(now_));
    if (&stored == &canopy_) out_ = std::clamp(most, 0.0, stored.length);
    record(tension, empty);
    if (empty) {
      apart_ += stored.length;
      return true;
    }
  }
  result_.stopped = fmt::format(
      "{:.3g} of {:.3g} m of {} have left the bag after {:g} s: at {:.3g} m/s the pull on the bag does not "
      "exceed the {:.3g} N that they resist with",
      most, stored.length, what, longest_unreeling, now_.v[payload], resistance);
  return false;
}

/// Skirt and canopy outside of the bag, bag and canopy in it [kg].
std::pair<double, double> Deployer::skirt_and_bag(double out) const {
  const double emerged =
      packed_.lines_first ? canopy_.mass(std::max(out, edge_out * canopy_.length)) : packed_.canopy_mass;
  return {emerged, packed_.bag_mass + packed_.canopy_mass - emerged};
}

double Deployer::emerged(const Motion& m) const {
  return packed_.lines_first ? std::clamp(m.x[skirt] - m.x[bag], out_, canopy_.length) : canopy_.length;
}

// Three bodies: the payload p, the skirt e with the canopy that is out, and the bag b with the rest of it. T is the
// tension of the lines, u the speed of the skirt relative to the bag, F the strip force.
//   m_p v_p' = -D_p - T,   m_e v_e' = T - F - mu u^2,   m_b v_b' = F - D_b
// Skirt and bag move as one body while that needs less than F. An empty bag flies on by itself; canopy first, the pilot
// chute stays on the vent.
Motion Deployer::stretch_rate(const Motion& m) {
  const auto [me, mb] = skirt_and_bag(emerged(m));
  const double mp = packed_.payload_mass + packed_.lines_mass, u = m.v[skirt] - m.v[bag];
  const double db =
      drag(packed_.bag_drag_area + (packed_.lines_first ? 0 : packed_.canopy_drag_area), m.v[bag]);
  tension_ = curve_.at(m.x[payload] - m.x[skirt] - apart_);
  Motion d;
  d.x = m.v;
  d.v[payload] = acceleration(-drag(packed_.payload_drag_area, m.v[payload]) - tension_, mp);
  const bool whole = packed_.lines_first && emerged(m) >= canopy_.length;
  const double needed = mb * (tension_ - db) / (me + mb) + db;
  stuck_ = !packed_.lines_first || (!whole && u <= 0 && needed <= packed_.strip_force);
  if (stuck_) {
    d.v[skirt] = d.v[bag] = acceleration(tension_ - db, me + mb);
  } else if (whole) {
    d.v[skirt] = acceleration(tension_, me);
    d.v[bag] = mb > 0 ? acceleration(-db, mb) : d.v[skirt];
  } else {
    const double impact = canopy_.per_length(emerged(m)) * std::max(u, 0.0) * std::max(u, 0.0);
    d.v[skirt] = acceleration(tension_ - packed_.strip_force - impact, me);
    d.v[bag] = acceleration(packed_.strip_force - db, mb);
  }
  return d;
}

double Deployer::stretch_step() const {
  const auto [skirt_mass, bag_mass] = skirt_and_bag(out_);
  const double lightest = stuck_ ? skirt_mass + bag_mass : skirt_mass;
  const double inverse = 1 / lightest + 1 / (packed_.payload_mass + packed_.lines_mass);
  const double away = std::abs(now_.v[skirt] - now_.v[bag]);
  const double emerging = std::max(out_, edge_out * canopy_.length) / (steps_a_radian * std::max(away, 1e-9));
  return std::min({longest_step, emerging, 1 / (steps_a_radian * std::sqrt(stiffest_ * inverse))});
}

/// Whether the lines may pull with half of the strip force after a step of `h` [s].
bool Deployer::may_slip(double h) const {
  const double ahead =
      now_.x[payload] - now_.x[skirt] - apart_ + h * std::max(now_.v[payload] - now_.v[skirt], 0.0);
  return ahead > 0 && 2 * curve_.at(std::min(ahead, curve_.stretch.back())) >= packed_.strip_force;
}

void Deployer::stretch() {
  const double end = time_ + longest_stretch;
  const bool strips = packed_.lines_first;
  const auto rate = [&](const Motion& m) { return stretch_rate(m); };
  double highest = 0;
  if (!strips) out_ = canopy_.length;
  for (bool stripping = false; time_ < end;) {
    const double before = out_;
    double h = stretch_step();
    if (strips && stuck_ && may_slip(h))
      stuck_ = false, h = stretch_step();  // the light skirt needs a short step
    now_ = step(now_, h, rate), time_ += h;
    if (strips && now_.v[skirt] < now_.v[bag] &&
        before < canopy_.length) {  // no cloth goes back into the bag
      const auto [me, mb] = skirt_and_bag(emerged(now_));
      now_.v[skirt] = now_.v[bag] = (me * now_.v[skirt] + mb * now_.v[bag]) / (me + mb);
    }
    if (!stuck_ && !stripping) begin(canopy_leaves), stripping = true;
    out_ = emerged(now_);
    if (strips && before < canopy_.length && out_ >= canopy_.length) begin(canopy_out);
    record(tension_, false);
    highest = std::max(highest, tension_);
    // The end: the canopy is out, and the lines have had their largest stretch.
    if (out_ < canopy_.length || highest == 0 || now_.v[skirt] < now_.v[payload]) continue;
    if (!strips) begin(canopy_out);
    record(tension_, true);
    return;
  }
  if (out_ >= canopy_.length) return;
  result_.stopped = fmt::format(
      "{:.3g} of {:.3g} m of the canopy have left the bag {:g} s after line stretch: the lines pull with at "
      "most {:.3g} N, the strip force is {:.3g} N",
      out_, canopy_.length, longest_stretch, highest, packed_.strip_force);
}

// Lines first: the bag with the canopy flies off, the lines leave it. Canopy first: the bag stays with the payload, and
// the pilot chute pulls the vent, then the lines out of it.
Deployment Deployer::run() {
  const PackedParachute& p = packed_;
  begin(p.lines_first ? lines_leave : canopy_leaves);
  record(0, true);
  bool goes_on = true;
  if (p.lines_first) {
    goes_on = unreel(lines_, p.line_force, true, p.payload_mass, p.bag_mass + p.canopy_mass, p.bag_drag_area,
                     "lines and riser");
  } else {
    goes_on = unreel(canopy_, p.strip_force, false, p.payload_mass + p.lines_mass, p.bag_mass,
                     p.bag_drag_area, "the canopy");
    if (goes_on) {
      begin(lines_leave);
      goes_on = unreel(lines_, p.line_force, false, p.payload_mass, p.bag_mass + p.canopy_mass,
                       p.bag_drag_area + p.canopy_drag_area, "lines and riser");
    }
  }
  if (!goes_on) return result_;
  result_.relative_speed = now_.v[payload] - now_.v[bag];
  now_.v[skirt] = now_.v[bag];
  now_.x[skirt] = now_.x[bag];
  apart_ = now_.x[payload] - now_.x[bag];
  begin(lines_stretch);
  stretch();
  return result_;
}

void check(const PackedParachute& p) {
  require_positive("speed at the deployment (m/s)", p.speed);
  require_positive("density (kg/m3)", p.density);
  if (!std::isinf(p.payload_mass)) require_positive("payload mass (kg)", p.payload_mass);
  require_positive("mass of the canopy (kg)", p.canopy_mass);
  require_positive("length of the canopy (m)", p.canopy_length);
  require_positive("mass of lines and riser (kg)", p.lines_mass);
  const double most = std::numeric_limits<double>::max();
  for (const auto& [what, value] : {std::pair{"relative speed of the bag (m/s)", p.relative_speed},
                                    {"mass of the bag (kg)", p.bag_mass},
                                    {"drag area of the bag (m2)", p.bag_drag_area},
                                    {"drag area of the payload (m2)", p.payload_drag_area},
                                    {"line force (N)", p.line_force},
                                    {"strip force (N)", p.strip_force}})
    require_within(what, value, 0, most);
}

}  // namespace

const DeploymentPhase* Deployment::phase(const std::string& name) const {
  for (const DeploymentPhase& one : phases)
    if (one.name == name) return &one;
  return nullptr;
}

double emerged_mass(double mass, double whole, double length, bool skirt_first) {
  const double share = std::clamp(length / whole, 0.0, 1.0);
  return mass * (skirt_first ? share * (2 - share) : share * share);
}

Deployment deploy_parachute(const PackedParachute& packed) {
  check(packed);
  return Deployer(packed).run();
}

}  // namespace ripstop::inline flight
