#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"
#include "assembly/files/profile_drawing.hpp"

namespace cupola {
namespace {

/// The corners of a convex polygon, counter-clockwise about the z axis.
void check_corners(const Section& s, const Plan& plan) {
  const size_t n = plan.x.size();
  s.rule(n == plan.y.size(), "y", "must have as many numbers as x");
  s.rule(n == 0 || n >= 3, "x", "must have at least 3 corners");
  for (size_t i = 0; i < n && n == plan.y.size(); ++i) {
    const size_t j = (i + 1) % n, k = (i + 2) % n;
    const auto turn = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    s.rule(turn(plan.x[j] - plan.x[i], plan.y[j] - plan.y[i], plan.x[k] - plan.x[j], plan.y[k] - plan.y[j]) >
               0.0,
           "x",
           fmt::format("must be the corners of a convex polygon, counter-clockwise: it does not turn left at "
                       "({:g}, {:g})",
                       plan.x[j], plan.y[j]));
    s.rule(
        turn(plan.x[i], plan.y[i], plan.x[j], plan.y[j]) > 0.0, "x",
        fmt::format("must surround the z axis: the side from ({:g}, {:g}) does not", plan.x[i], plan.y[i]));
  }
}

void declare_plan(Section& s, Plan& plan) {
  using Kind = Plan::Kind;
  const auto kind = [](Kind which, const std::string& name, const std::string& meaning,
                       void (*keys)(Section&, Plan&)) {
    return Section::Alternative<Plan>{name, meaning, [which, keys](Section& section, Plan& p) {
                                        p.kind = which;
                                        keys(section, p);
                                      }};
  };
  s.variant<Plan>(
      "type", plan,
      {kind(Kind::line, "line", "arch or barrel along y",
            [](Section& section, Plan& p) {
              section.number("length", p.length, {.unit = "m", .above = 0}, "length of the barrel");
            }),
       kind(Kind::circle, "circle", "revolution about the z axis", [](Section&, Plan&) {}),
       kind(Kind::polygon, "polygon", "cloister vault over a regular polygon",
            [](Section& section, Plan& p) {
              section.integer("sides", p.sides, {.min = 3, .max = 1000}, "number of sides");
              section.choice("measured_at", p.measured_at,
                             "the profile is the section through a corner, or through the middle of a side");
            }),
       kind(Kind::corners, "corners", "cloister vault over a convex polygon",
            [](Section& section, Plan& p) {
              section.numbers("x", p.x, {.unit = "m"}, "corners, counter-clockwise");
              section.numbers("y", p.y, {.unit = "m"}, "corners, counter-clockwise");
              check_corners(section, p);
            }),
       kind(Kind::groin, "groin",
            "groin vault over a regular polygon: a barrel behind each side, whose profile spans the side",
            [](Section& section, Plan& p) {
              p.sides = 4;
              section.integer("sides", p.sides, {.min = 3, .max = 1000}, "number of sides");
              section.choice("groins", p.groins,
                             "stones across the groins in every course, in every other one, or in none");
              section.optional_number(
                  "from_height", p.from_height, {.unit = "m", .above = 0},
                  "where the extrados of the first beds is half as long as the shell is thick",
                  "height above the springing of the first beds, under which the supports lie");
              section.integer("springers", p.springers, {.min = 0, .max = 1000},
                              "courses above the supports that are one stone at each corner, on a level bed");
            })},
      "line over which the vault stands");
}

/// The points of a chain, in the case or in a file.
void declare_chain_points(Section& s, Profile& profile) {
  std::optional<double> span;
  s.file("file", profile.file,
         "CSV with the columns r, z and perhaps radius, or SVG with one path, instead of these keys");
  s.optional_number("span", span, {.unit = "m", .above = 0}, "that of the points",
                    "scales the points, so that they have this span at the springing");
  if (!profile.file.empty()) {
    for (const char* key : {"r", "z", "radius"})
      s.refuse(key, "remove this key, or `file`, which gives the points");
    if (is_drawing(profile.file)) {
      s.rule(span.has_value(), "file", "a drawing has no metres: give the span, too");
      profile.points = read_profile_drawing(profile.file, *span);
    } else {
      profile.points = read_profile_table(profile.file);
    }
  } else {
    s.numbers("r", profile.points.r, {.unit = "m"},
              "points from the springing upwards: distance from the axis");
    s.numbers("z", profile.points.z, {.unit = "m"}, "points from the springing upwards: height");
    s.numbers("radius", profile.points.radius, {.unit = "m"},
              "radius from each point to the next, positive where it turns towards the axis; "
              "0, or none: a straight line");
    s.rule(profile.points.r.size() == profile.points.z.size(), "z", "must have as many numbers as r");
  }
  if (span && !profile.points.r.empty()) {
    s.rule(profile.points.r.front() > 0.0, "span", "requires a first point away from the axis");
    scale_to_span(*span, &profile.points);
  }
}

void declare_profile(Section& s, Profile& profile) {
  using Kind = Profile::Kind;
  using Keys = void (*)(Section&, Profile&);
  constexpr Keys span = [](Section& section, Profile& p) {
    section.required_number("span", p.span, {.unit = "m", .above = 0}, "span, or diameter, at the springing");
  };
  constexpr Keys span_and_rise = [](Section& section, Profile& p) {
    section.required_number("span", p.span, {.unit = "m", .above = 0}, "span, or diameter, at the springing");
    section.required_number("rise", p.rise, {.unit = "m", .above = 0},
                            "height of the crown above the springing");
  };
  const auto kind = [](Kind which, const std::string& name, const std::string& meaning, Keys shared,
                       Keys own = nullptr) {
    return Section::Alternative<Profile>{name, meaning, [=](Section& section, Profile& p) {
                                           p.kind = which;
                                           if (shared) shared(section, p);
                                           if (own) own(section, p);
                                         }};
  };
  s.variant<Profile>(
      "type", profile,
      {kind(Kind::semicircle, "semicircle", "half a circle", span),
       kind(Kind::segmental, "segmental", "one arc, at most half a circle", span_and_rise,
            [](Section& section, Profile& p) {
              section.rule(p.rise <= 0.5 * p.span, "rise", "must be at most half the span");
            }),
       kind(Kind::pointed, "pointed", "two arcs that meet at a point", span,
            [](Section& section, Profile& p) {
              section.number("radius_ratio", p.radius_ratio, {.above = 0.5, .max = 1e3},
                             "radius over span: 0.8 pointed fifth, 1 equilateral");
            }),
       kind(Kind::basket, "basket", "three arcs that meet smoothly", span_and_rise,
            [](Section& section, Profile& p) {
              section.number("haunch_radius", p.haunch_radius, {.unit = "m", .above = 0},
                             "radius of the two lower arcs");
            }),
       kind(Kind::horseshoe, "horseshoe", "a circle that continues below its centre", span,
            [](Section& section, Profile& p) {
              section.number("below_deg", p.below_deg, {.unit = "deg", .above = 0, .below = 90},
                             "angle by which it continues; the span is the diameter");
            }),
       kind(Kind::ellipse, "ellipse", "half an ellipse", span_and_rise),
       kind(Kind::parabola, "parabola", "a parabola", span_and_rise),
       kind(Kind::catenary, "catenary", "the shape of a hanging chain", span_and_rise),
       kind(Kind::straight, "straight", "a wall, pier or drum", span,
            [](Section& section, Profile& p) {
              section.required_number("height", p.height, {.unit = "m", .above = 0}, "height");
              section.number("batter", p.batter, {.min = -5, .max = 5}, "lean inwards, over the height");
            }),
       kind(Kind::chain, "chain", "lines and arcs from point to point", nullptr,
            [](Section& section, Profile& p) { declare_chain_points(section, p); })},
      "section of the vault");
}

}  // namespace

void expect_length(const Section& s, const char* key, double value, double low, double high) {
  s.expect({key, value, "m", low, high, kKilometres, kMillimetres});
}

void declare_shell_thickness(Section& s, double& thickness, double most, const std::string& meaning) {
  if (s.parent_gives("wythes"))
    return s.refuse("thickness", "remove this key: geometry.wythes gives the thickness of each wythe");
  s.number("thickness", thickness, {.unit = "m", .above = 0}, meaning);
  expect_length(s, "thickness", thickness, kThinnest, std::min(kThickest, most));
}

void declare_vault(Section& s, VaultSurface& vault) {
  s.section("plan", vault.plan, "line over which the vault stands", declare_plan);
  s.section("profile", vault.profile, "section of the vault", declare_profile);
  expect_length(s, "profile.span", vault.profile.width());
  declare_shell_thickness(s, vault.thickness, 0.5 * vault.profile.width(),
                          "thickness, normal to the profile");
  s.choice("beds", vault.beds,
           "plane and normal to the profile, on cones about the axis, level, or at bed_angles_deg");
  s.numbers(
      "bed_angles_deg", vault.bed_angles_deg, {.unit = "deg", .min = -90, .max = 180},
      "rise of given beds outwards: from the first to the last, of an arch to the crown, at equal numbers "
      "of courses; linear between");
  s.rule((vault.beds == VaultSurface::Beds::given) == !vault.bed_angles_deg.empty(), "bed_angles_deg",
         "belongs to beds: given, and only there");
  s.rule(vault.bed_angles_deg.size() != 1, "bed_angles_deg", "must be at least 2 angles");
  s.rule(
      !vault.plan.closed() || vault.bed_angles_deg.empty() || std::abs(vault.bed_angles_deg.front()) < 90.0,
      "bed_angles_deg",
      "must begin above -90 and below 90 deg on a closed plan: the first bed lies on a ring");
  s.choice("courses", vault.courses,
           "what is equal from course to course: length along the drawn line, height, or turn of its normal");
  s.choice("line", vault.line, "what the profile draws");
  s.number("eye", vault.eye, {.unit = "m", .min = 0},
           "distance of the last bed from the axis, on the drawn line; 0: the end of the profile");
  s.flag("key_stone", vault.key_stone, "close the eye by one stone");
  s.integer("voussoir_segments", vault.voussoir_segments, {.min = 1, .max = 1000},
            "straight segments that approximate the curved faces of a block");
  const bool on_line = !vault.plan.closed();
  const bool is_groin = vault.plan.kind == Plan::Kind::groin;
  s.rule(vault.beds != VaultSurface::Beds::conical ||
             (vault.plan.kind == Plan::Kind::polygon && vault.plan.measured_at == Plan::MeasuredAt::corner),
         "beds", "conical requires plan: {type: polygon, measured_at: corner}");
  s.rule(vault.eye == 0.0 || !on_line, "eye", "requires a closed plan");
  s.rule(!is_groin || vault.profile.kind != Profile::Kind::straight, "profile",
         "a groin vault requires a profile that reaches the crown");
  s.rule(!is_groin || vault.voussoir_segments == 1, "voussoir_segments",
         "must be 1 in a groin vault; lay more courses instead");
  s.rule(!is_groin || vault.beds == VaultSurface::Beds::normal, "beds", "must be normal in a groin vault");
  s.rule(!vault.key_stone || !on_line, "key_stone", "requires a closed plan");
  s.rule(!vault.key_stone || vault.eye > 0.0, "key_stone", "requires the radius of its `eye`");
  s.rule(
      !vault.key_stone || vault.plan.kind == Plan::Kind::circle || vault.beds == VaultSurface::Beds::normal,
      "key_stone", "requires beds: normal over a polygon");
  s.rule(!vault.key_stone || !s.parent_gives("wythes"), "key_stone", "requires a shell without wythes");
  s.rule(vault.profile.kind != Profile::Kind::chain || vault.profile.points.r.size() >= 2, "profile",
         "a chain has at least 2 points");
  s.rule(vault.line == VaultSurface::Line::intrados || !s.parent_gives("wythes"), "line",
         "requires a shell without wythes");
}

}  // namespace cupola
