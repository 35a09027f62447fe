#include "sem/scene/read_scene.h"
#include "sem/scene/json_text.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sem/base/error.h"
#include "sem/method/resolved_rule.h"
#include "sem/method/trims.h"
#include "sem/scene/files.h"

namespace sem {
namespace {

constexpr int many = 1 << 30;
constexpr double max_points = 1e7;  // of the interior quadrature: some GB of operators

void describe_material(Fields& fields, Material& m) {
  fields.choice("model", m.model, {"linear", "stvk", "corotated", "neo_log", "neo_ref", "neo_iso"},
                "energy density; see the material table of the README");
  fields.number("youngs_modulus", m.youngs_modulus, positive, "Pa", "E");
  fields.number("poisson_ratio", m.poisson_ratio, inside_of(-1, 0.5), "", "nu");
  fields.number("density", m.density, at_least(0), "kg/m^3", "rho, mass per rest volume (2D: per unit thickness)");
}

template <int ParamDim, int Dim>
void describe_nurbs(Fields& fields, Nurbs<ParamDim, Dim>& shape, const char* unit, const char* meaning) {
  for (int axis = 0; axis < ParamDim; ++axis) {
    const std::string suffix = DimTraits<ParamDim + 1>::parameter_suffix[axis];
    const std::string degree = "degree" + suffix, knots = "knots" + suffix;
    fields.require(degree.c_str());
    fields.integer(degree.c_str(), shape.degree[axis], 1, max_nurbs_degree, "degree of the NURBS");
    fields.require(knots.c_str());
    fields.numbers(knots.c_str(), shape.knots[axis], 0, any_number, "",
                   "non-decreasing, as many as control points along the parameter + degree + 1");
  }
  fields.require("control_points");
  fields.points<Dim>("control_points", shape.control_points, unit, meaning);
  const int n = int(shape.control_points.cols());
  std::vector<double> weights(shape.weights.begin(), shape.weights.end());
  if (fields.optional("weights", !shape.weights.isOnes(0)))
    fields.numbers("weights", weights, fields.reading() ? std::max(1, n) : 0, positive, "", "of the control points; all 1 if absent");
  else
    weights.assign(n, 1);
  if (fields.reading()) {
    shape.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()));
    check(shape, fields.file(), fields.path());
  }
}

void describe_trim_loop(Fields& fields, std::vector<Nurbs<1, 2>>& loop) {
  fields.items<Nurbs<1, 2>>("curves", loop, "that close the loop, in any order and orientation",
                            [](Fields& f, Nurbs<1, 2>& curve) {
                              describe_nurbs(f, curve, "", "(u, v) in the part's domain");
                            });
}

template <int Dim>
void describe_part(Fields& fields, ScenePart<Dim>& part) {
  fields.text("name", part.name, "unique in the solid; the text before any dot is a group that the part belongs to");
  describe_nurbs(fields, part.shape, "m", "at rest; the first parameter runs fastest");
  if (DimTraits<Dim>::param_dim == 2 && fields.optional("trims", !part.trims.empty())) {
    fields.items<std::vector<Nurbs<1, 2>>>("trims", part.trims, "loops that the part is trimmed to, nested by parity; absent: all of its domain",
                                           describe_trim_loop);
    if (fields.reading()) check_trims<Dim>(part.shape, part.trims, fields.file(), fields.path("trims"));
  }
  if (fields.optional("material", part.material.has_value())) {
    if (!part.material) part.material.emplace();
    fields.object("material", "in place of the solid's where this part's distance weight is the largest",
                  [&](Fields& f) { describe_material(f, *part.material); });
  }
  if (fields.optional("color", part.color.has_value())) {
    std::vector<double> color(3, 0.0);
    if (part.color) color.assign(part.color->begin(), part.color->end());
    fields.numbers("color", color, 3, between(0, 1), "", "red, green, blue, linear; kept for CAD files");
    if (fields.reading()) part.color = std::array{color[0], color[1], color[2]};
  }
}

template <int Dim>
void describe_named_shape(Fields& fields, std::vector<ScenePart<Dim>>& parts, const ShapeLibrary<Dim>& shapes) {
  std::string name;
  fields.text("name", name, "put before the names of the shape's parts: \"handle\" and \"side.2\" make \"handle.side.2\"; a 'material' of the shape is that of all its parts");
  const size_t first = parts.size();
  shapes(fields, parts);
  for (size_t i = first; i < parts.size() && !name.empty(); ++i) parts[i].name = name + '.' + parts[i].name;
  if (!fields.reading() || !fields.optional("material", false)) return;
  Material material;
  fields.object("material", "", [&](Fields& f) { describe_material(f, material); });
  for (size_t i = first; i < parts.size(); ++i) parts[i].material = material;
}

template <int Dim>
void describe_solid(Fields& fields, SceneSolid<Dim>& solid, const ShapeLibrary<Dim>& shapes) {
  fields.text("name", solid.name, "unique in the scene");
  fields.object("material", "of the whole solid", [&](Fields& f) { describe_material(f, solid.material); });
  fields.items<ScenePart<Dim>>("parts", solid.parts, "the NURBS that bound the solid, in any order and orientation",
                               describe_part<Dim>);
  if (shapes && fields.optional("shape", false))
    fields.object("shape", "parts from the shape library, beside 'parts' or in their place",
                  [&](Fields& f) { describe_named_shape(f, solid.parts, shapes); });
  if (shapes && fields.optional("shapes", false))
    fields.list("shapes", "several of them, as in 'shape'", 0, [](int) {}, [&](Fields& f, int) {
      if (!f.documenting()) describe_named_shape(f, solid.parts, shapes);
    });
  if (!fields.reading()) return;
  if (solid.parts.empty()) fields.reject(nullptr, "no part", "'parts' or a 'shape'");
  std::set<std::string> names;
  for (size_t i = 0; i < solid.parts.size(); ++i) {
    std::string& name = solid.parts[i].name;
    if (name.empty()) name = "part." + std::to_string(i + 1);
    if (!names.insert(name).second) fields.reject("parts", "two parts named '" + name + "'", "a name of its own for each part");
    const Points<Dim>& points = solid.parts[i].shape.control_points;
    if ((points.rowwise().maxCoeff() - points.rowwise().minCoeff()).isZero(0))
      fields.reject("parts", "all control points of '" + name + "' in one place", "a part of some extent");
  }
}

template <int Dim>
void describe_method(Fields& fields, MethodOptions& m) {
  fields.choice("formulation", m.formulation, {"projected", "condensed"}, "projected: the paper's, unknowns are the control points; condensed: the polynomials' coefficients, converges");
  if (fields.reading()) m.interior_rule.weight_tolerance = usual_weight_tolerance<Dim>;
  // What converges is the default of the formulation that is meant to.
  if (fields.reading() && m.formulation == Formulation::condensed) {
    m.weights.variant = DistanceWeight::sided;
    m.patch_levels = usual_patch_levels<Dim>;
    m.layers = usual_layers;
    m.interior_rule.rule = InteriorRule::resolved;
  }
  fields.integer("degree", m.projection.degree, 1, 4, "n, degree of the deformation polynomials");
  fields.choice("own_pressure", m.own_pressure, {"automatic", "always", "never"},
                "condensed: a pressure of its own, against locking, for materials with a Poisson's ratio from 0.4 on, above 0, for none");
  fields.choice("fit", m.projection.fit, {"degree_by_degree", "degree_by_degree_raw", "pseudo_inverse"},
                "projection; pseudo_inverse is the draft's");
  fields.object("samples", "boundary samples", [&](Fields& f) {
    f.integer("points_per_span", m.sampling.points_per_span, 0, 1000, "Gauss-Lobatto points per knot span; 0: NURBS degree + 1");
    if (m.sampling.points_per_span == 1) f.reject("points_per_span", "1", "0 or at least 2");
    f.choice("weight", m.sampling.weight, {"measure", "uniform"}, "arc length or area, or all the same (the draft)");
  });
  fields.object("quadrature", "interior quadrature", [&](Fields& f) {
    f.choice("method", m.interior_rule.rule, {"rays", "split_rays", "fans", "exact", "resolved"},
             "rays: the grid below (the paper's); the others reach a tolerance with few points: rays between critical values, a fan about an ellipse where one applies, the cheaper of both; resolved: cells refined until they resolve the weights, default with condensed");
    f.number("weight_tolerance", m.interior_rule.weight_tolerance, inside_of(0, 1), "", "resolved: relative change that refining cells may still bring; in space 0.003 unless said");
    f.number("tolerance", m.interior_rule.tolerance, inside_of(0, 1), "", "not rays: relative error of smooth integrands (moments to degree 6, exp, waves)");
    f.number("waves", m.interior_rule.waves, inside_of(0, 1000), "", "not rays: waves over the body's largest extent that are resolved");
    f.integer("fit", m.interior_rule.fit, 0, 20, "> 0: new weights >= 0 that match the boundary's own moments to this degree");
    f.integer("compress", m.interior_rule.compress, 0, 20, "> 0: few points with weights > 0 and the same moments to this degree");
    f.option("axis", m.rays.axis, DimTraits<Dim>::axes(), "direction of the rays");
    f.integer("rays", m.rays.n_rays, 1, 100000, "rays per transverse direction");
    f.choice("grid", m.rays.grid, {"midpoint", "gauss"}, "where the rays stand");
    f.choice("rule", m.interval.rule, {"midpoint", "gauss"}, "points in each interval of a ray");
    f.integer("points", m.interval.points, 1, 10000, "points per interval, if spacing is 0");
    f.number("spacing", m.interval.spacing, at_least(0), "m", "> 0: as many points as keep this distance");
    const double n_rays = std::pow(m.rays.n_rays, Dim - 1);
    if (n_rays > max_points)
      f.reject("rays", exact_text(n_rays) + " rays", "at most " + exact_text(max_points) + " in all");
    if (m.interval.spacing == 0 && n_rays * m.interval.points > max_points)
      f.reject("points", exact_text(n_rays * m.interval.points) + " on all rays", "at most " + exact_text(max_points));
  });
  fields.object("weights", "blending weights", [&](Fields& f) {
    f.choice("distance", m.weights.variant, {"published", "draft", "distance_only", "sided"}, "formula of the distance weight theta; default with condensed: sided");
    f.number("side_ramp", m.weights.side_ramp, {0, 1, true, false}, "", "s of the sided weight: it ends where the cosine to the inner normal is -s");
    f.integer("patch_levels", m.patch_levels, 0, 8, "patches at each joint that is re-entrant or where pins or boundary loads change, each half the one before (condensed)");
    f.integer("layers", m.layers, 0, 8, "at most so many further weights of each part whose extent is below a quarter of the cutoff, each reaching half as far as the one before (condensed, sided)");
    if (f.optional("sparsity", m.weights.sparsity.has_value())) {
      if (f.reading() && f.optional("cutoff", false)) f.reject("cutoff", "both cutoff and sparsity", "one of them");
      if (!m.weights.sparsity) m.weights.sparsity = 0.3;
      f.number("sparsity", *m.weights.sparsity, {0, 1, true, false}, "", "in place of cutoff: share of non-zero weights");
      if (f.documenting()) m.weights.sparsity.reset();
    }
    if (!m.weights.sparsity) f.number("cutoff", m.weights.cutoff, positive, "m", "alpha, where weights end");
  });
  fields.choice("origins", m.origins, {"one", "shared_parts"}, "deformation origins: one for all (the draft), or by shared parts");
  fields.integer("kept_columns", m.kept_columns, 0, many, "draft eq. 14: columns of B kept per point, 0: all");
  fields.boolean("renormalise", m.renormalise, "after pruning, so that translations stay exact");
  fields.integer("threads", m.n_threads, 1, 256, "for the preparation; results do not depend on it");
}

template <int Dim>
void describe_box(Fields& fields, Box<Dim>& box) {
  fields.require("lower");
  fields.vector<Dim>("lower", box.lower, "m", "corner");
  fields.require("upper");
  fields.vector<Dim>("upper", box.upper, "m", "opposite corner");
  if ((box.lower.array() > box.upper.array()).any())
    fields.reject("lower", "a corner above 'upper'", "lower <= upper in every coordinate");
}

template <int Dim>
void describe_selector(Fields& fields, Selector<Dim>& where, bool controls) {
  fields.text("part", where.part, "name or group of parts, also as solid/part; empty: any");
  if (fields.optional("box", where.box.has_value())) {
    if (!where.box) where.box = Box<Dim>{Vec<Dim>::Zero(), Vec<Dim>::Zero()};
    fields.object("box", "only what lies in this box at rest", [&](Fields& f) { describe_box<Dim>(f, *where.box); });
  }
  if (controls && fields.optional("control_points", !where.control_points.empty()))
    fields.integers("control_points", where.control_points, 0, "only these, counted from 0 in each part");
}

// Components by their names, "xy"; all if absent.
template <int Dim>
void describe_axes(Fields& fields, const char* key, std::array<bool, Dim>& held, const char* meaning) {
  std::string axes;  // all, or when writing those held
  for (int a = 0; a < Dim; ++a)
    if (fields.reading() || fields.documenting() || held[a]) axes += DimTraits<Dim>::axis_name[a];
  fields.text(key, axes, meaning);
  const std::string allowed = std::string("some of ") + DimTraits<Dim>::axis_name;
  if (axes.empty()) fields.reject(key, "no axis", allowed);
  if (fields.reading()) held.fill(false);
  for (const char axis : axes) {
    const auto at = std::string(DimTraits<Dim>::axis_name).find(axis);
    if (at == std::string::npos)
      fields.reject(key, std::string("'") + axis + "'", allowed);
    else
      held[at] = true;
  }
}

// A pin that moves needs time for it where there is time.
template <int Dim>
void check_motion(Fields& fields, const Pin<Dim>& pin, int index, AnalysisKind kind) {
  const std::string here = "pins[" + std::to_string(index) + "].";
  const std::string motion = pin.rotation.isZero(0) ? "displacement" : "rotation";
  if (pin.moves() && kind == AnalysisKind::modes)
    fields.reject((here + motion).c_str(), "a prescribed " + motion, "this only in a static or dynamic analysis");
  if (pin.moves() && kind == AnalysisKind::dynamics && pin.duration == 0)
    fields.reject((here + "duration").c_str(), "0 with a prescribed " + motion, "> 0 s in a dynamic analysis");
  if (pin.duration > 0 && !(pin.moves() && kind == AnalysisKind::dynamics))
    fields.reject((here + "duration").c_str(), exact_text(pin.duration), "this only for pins that move in a dynamic analysis");
}

template <int Dim>
void describe_pin(Fields& fields, Pin<Dim>& pin) {
  describe_selector(fields, pin.where, true);
  describe_axes<Dim>(fields, "axes", pin.axes, "components held");
  fields.vector<Dim>("displacement", pin.displacement, "m", "prescribed displacement");
  std::vector<double> rotation(pin.rotation.begin(), pin.rotation.end());
  fields.numbers("rotation", rotation, DimTraits<Dim>::n_rotations, any_number, "rad",
                 "prescribed turn about 'center', any number of times: the angle; 3D: times the axis");
  for (size_t a = 0; a < rotation.size(); ++a) pin.rotation[a] = rotation[a];
  fields.vector<Dim>("center", pin.center, "m", "of the turn");
  fields.number("duration", pin.duration, at_least(0), "s",
                "dynamic: how long the pin takes to get there, from rest to rest (r^2 (3 - 2 r), r = t / duration)");
}

void describe_oscillation(Fields& fields, Oscillation& oscillation) {
  fields.number("amplitude", oscillation.amplitude, any_number, "", "dynamic: the load is multiplied by 1 + amplitude sin(2 pi t / period)");
  fields.number("period", oscillation.period, positive, "s", "dynamic: of the amplitude");
}

// The loads of a scene as one list with a type each.
template <int Dim>
void describe_loads(Fields& fields, Scene<Dim>& scene) {
  const int n_point = int(scene.point_loads.size()), n_boundary = int(scene.boundary_loads.size());
  const int n = n_point + n_boundary + int(scene.body_loads.size());
  fields.list("loads", "dead loads; 2D: per unit thickness", n, [](int) {}, [&](Fields& f, int i) {
    int type = i < n_point ? 0 : i < n_point + n_boundary ? 1 : 2;
    f.require("type");
    f.option("type", type, {"point", "boundary", "body"}, "what the load acts on");
    const auto describe_point = [&](PointLoad<Dim>& load) {
      f.require("at");
      f.vector<Dim>("at", load.at, "m", "point: a rest point in or on the body");
      f.require("force");
      f.vector<Dim>("force", load.force, "N", "point: force; body: force per volume in N/m^3");
      describe_oscillation(f, load.oscillation);
    };
    const auto describe_boundary = [&](BoundaryLoad<Dim>& load) {
      describe_selector(f, load.where, false);
      f.vector<Dim>("traction", load.traction, "Pa", "boundary: force per length (2D) or area, fixed direction");
      f.number("pressure", load.pressure, any_number, "Pa", "boundary: pushes against the outward rest normal");
      if (!f.documenting()) describe_oscillation(f, load.oscillation);
    };
    const auto describe_body = [&](BodyLoad<Dim>& load) {
      f.require("force");
      f.vector<Dim>("force", load.force, "N/m^3", "body: force per rest volume");
      f.text("solid", load.solid, "body: only this solid; empty: all");
      describe_oscillation(f, load.oscillation);
    };
    if (f.documenting()) {
      PointLoad<Dim> point{Vec<Dim>::Zero(), Vec<Dim>::Zero(), 0, {}};
      BoundaryLoad<Dim> boundary;
      BodyLoad<Dim> body{"", Vec<Dim>::Zero(), 0, {}};
      describe_point(point);
      describe_boundary(boundary);
      f.text("solid", body.solid, "body: only this solid; empty: all");
    } else if (f.reading()) {
      const auto add = [&](auto& loads) -> auto& {
        auto& load = loads.emplace_back();
        load.index = i;
        return load;
      };
      if (type == 0) describe_point(add(scene.point_loads));
      if (type == 1) describe_boundary(add(scene.boundary_loads));
      if (type == 2) describe_body(add(scene.body_loads));
    } else {
      if (type == 0) describe_point(scene.point_loads[i]);
      if (type == 1) describe_boundary(scene.boundary_loads[i - n_point]);
      if (type == 2) describe_body(scene.body_loads[i - n_point - n_boundary]);
    }
  });
}

template <int Dim>
void describe_probe(Fields& fields, Probe<Dim>& probe) {
  fields.require("name");
  fields.text("name", probe.name, "starts the probe's columns in history.csv");
  fields.choice("type", probe.kind, {"displacement", "stress", "reaction"}, "what is written over time (stress: Cauchy)");
  const bool at_pin = probe.kind == ProbeKind::reaction;
  if (!at_pin || fields.documenting()) {
    fields.require("at");
    fields.vector<Dim>("at", probe.at, "m", "displacement, stress: a rest point in or on the body");
  }
  const bool displacement = probe.kind == ProbeKind::displacement;
  if (displacement && fields.optional("truth", probe.truth.has_value())) {
    if (!probe.truth) probe.truth = Vec<Dim>::Zero();
    fields.vector<Dim>("truth", *probe.truth, "m", "displacement: the exact value at the end, if known; the report compares");
    describe_axes<Dim>(fields, "truth_axes", probe.truth_axes, "components of 'truth' that are known");
  }
  if (at_pin || fields.documenting()) {
    fields.require("pin");
    fields.integer("pin", probe.pin, 0, many, "reaction: index of the pin, from 0");
  }
}

void describe_analysis(Fields& fields, Analysis& a) {
  fields.choice("type", a.kind, {"static", "dynamic", "modes"}, "what is computed");
  if (a.kind == AnalysisKind::dynamics || fields.documenting()) {
    fields.choice("integrator", a.integrator, {"linearly_implicit_euler", "implicit_euler", "implicit_midpoint"},
                  "dynamic: time integration");
    fields.number("time_step", a.time_step, positive, "s", "dynamic: length of a step");
    fields.number("duration", a.duration, positive, "s", "dynamic: simulated time");
    if (a.duration < a.time_step || a.duration > 1e9 * a.time_step)
      fields.reject("duration", exact_text(a.duration), "1 to 1e9 times the time_step, " + exact_text(a.time_step));
  }
  if (a.kind == AnalysisKind::statics || fields.documenting()) {
    fields.integer("load_steps", a.load_steps, 1, 100000, "static: steps from no load to all");
    fields.integer("max_iterations", a.max_iterations, 1, 100000, "static: Newton iterations per load step");
    fields.number("tolerance", a.tolerance, inside_of(0, 1), "", "static: relative residual");
  }
  if (a.kind == AnalysisKind::modes || fields.documenting())
    fields.integer("count", a.n_modes, 1, 100000, "modes: how many of the lowest");
}

void describe_output(Fields& fields, OutputOptions& o) {
  fields.number("frame_rate", o.frame_rate, between(0, 1e6), "1/s", "frames per simulated second; 0: none");
  fields.integer("width", o.width, 16, 8192, "of a frame, pixels");
  fields.integer("height", o.height, 16, 8192, "of a frame, pixels");
  if (fields.optional("view", o.view.has_value())) {
    if (!o.view) o.view = Box<2>{Vec<2>::Zero(), Vec<2>::Ones()};
    fields.object("view", "what a frame shows; the rest shape with room around it if absent",
                  [&](Fields& f) { describe_box<2>(f, *o.view); });
  }
  fields.boolean("error_estimate", o.error_estimate, "repeat the run with varied settings to judge the probes");
  fields.number("checkpoint_interval", o.checkpoint_interval, at_least(0), "s", "simulated time between checkpoints; 0: only at the end");
}

// What the text may name that is not there.
template <int Dim>
void check_names(Fields& fields, const Scene<Dim>& scene) {
  std::vector<std::string> parts, solids;
  for (const auto& solid : scene.solids) {
    solids.push_back(solid.name);
    for (const auto& part : solid.parts) {
      for (size_t end = part.name.find('.');; end = part.name.find('.', end + 1)) {
        const std::string name = part.name.substr(0, end);
        for (const auto& known : {name, solid.name + "/" + name})
          if (std::find(parts.begin(), parts.end(), known) == parts.end()) parts.push_back(known);
        if (end == std::string::npos) break;
      }
    }
  }
  const auto check_name = [&](const std::string& name, const std::vector<std::string>& known, const std::string& where) {
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
    std::string all;
    for (const auto& one : known) all += (all.empty() ? "" : ", ") + one;
    const std::string close = closest_name(name, known);
    fields.reject(where.c_str(), "'" + name + "'",
                  (close.empty() ? "" : "'" + close + "' (did you mean that?), or ") + ("one of " + all));
  };
  for (size_t i = 0; i < scene.pins.size(); ++i)
    check_name(scene.pins[i].where.part, parts, "pins[" + std::to_string(i) + "].part");
  for (const auto& load : scene.boundary_loads)
    check_name(load.where.part, parts, "loads[" + std::to_string(load.index) + "].part");
  for (const auto& load : scene.body_loads)
    check_name(load.solid, solids, "loads[" + std::to_string(load.index) + "].solid");
  std::set<std::string> probes;
  for (size_t i = 0; i < scene.probes.size(); ++i) {
    const auto& probe = scene.probes[i];
    const std::string where = "probes[" + std::to_string(i) + "]";
    if (!probes.insert(probe.name).second) fields.reject(where.c_str(), "a second probe named '" + probe.name + "'", "a name of its own for each");
    if (probe.name.find_first_of(",\"\n") != std::string::npos || probe.name.empty())
      fields.reject((where + ".name").c_str(), "'" + probe.name + "'", "a name without commas, quotes and line ends");
    if (probe.kind == ProbeKind::reaction && probe.pin >= int(scene.pins.size()))
      fields.reject((where + ".pin").c_str(), std::to_string(probe.pin), "the index of one of the " + std::to_string(scene.pins.size()) + " pins, from 0");
  }
}

template <int Dim>
void describe_scene(Fields& fields, Scene<Dim>& scene, const ShapeLibrary<Dim>& shapes) {
  fields.text("name", scene.name, "of the scene");
  fields.text("description", scene.description, "one line");
  int dimension = Dim;
  fields.integer("dimension", dimension, 2, 3, "2 or 3, as the program");
  if (dimension != Dim) fields.reject("dimension", std::to_string(dimension), std::to_string(Dim) + " in this program");
  fields.require("solids");
  fields.items<SceneSolid<Dim>>("solids", scene.solids, "one or more; their union is the body",
                                [&](Fields& f, SceneSolid<Dim>& solid) { describe_solid(f, solid, shapes); });
  fields.object("method", "the stages of the method", [&](Fields& f) { describe_method<Dim>(f, scene.method); });
  fields.object("stability", "ties the map to the boundary", [&](Fields& f) {
    f.number("stiffness", scene.stability_stiffness, at_least(0), "Pa/m", "gamma of the stability energy; 0: 10 n^2 E / h with E of the first solid and h the mean size of a part");
    f.number("clamp_penalty", scene.clamp_penalty, positive, "", "beta / n^2 of the condensed formulation's clamps (Nitsche)");
    f.number("kinetic_length", scene.kinetic_length, at_least(0), "m", "l of the kinetic stability term (draft); 0: off");
  });
  fields.vector<Dim>("gravity", scene.gravity, "m/s^2", "acceleration of gravity");
  describe_loads(fields, scene);
  fields.items<Pin<Dim>>("pins", scene.pins, "control points held; those that coincide with one are held with it", describe_pin<Dim>);
  fields.object("initial", "motion at the start (dynamic analysis)", [&](Fields& f) {
    f.vector<Dim>("velocity", scene.velocity, "m/s", "of the whole body");
    f.number("angular_velocity", scene.angular_velocity, any_number, "rad/s", "about the centroid (3D: about z)");
  });
  fields.items<Probe<Dim>>("probes", scene.probes, "values of interest", describe_probe<Dim>);
  fields.number("accuracy_seconds", scene.accuracy_seconds, positive, "s", "refining to `accuracy` does not begin what would end later");
  fields.number("accuracy", scene.accuracy, {0, 1, false, true}, "", "> 0: parts, degree, quadrature and time step are refined until the probes' (frequencies') estimated relative error is below (condensed)");
  fields.object("analysis", "what to compute", [&](Fields& f) { describe_analysis(f, scene.analysis); });
  fields.object("output", "what to write", [&](Fields& f) { describe_output(f, scene.output); });
  if (!fields.reading()) return;
  if (scene.solids.empty()) fields.reject("solids", "an empty list", "at least one solid");
  std::set<std::string> names;
  for (size_t i = 0; i < scene.solids.size(); ++i) {
    if (scene.solids[i].name.empty()) scene.solids[i].name = "solid." + std::to_string(i + 1);
    if (!names.insert(scene.solids[i].name).second)
      fields.reject("solids", "two solids named '" + scene.solids[i].name + "'", "a name of its own for each");
  }
  for (size_t i = 0; i < scene.pins.size(); ++i) check_motion(fields, scene.pins[i], int(i), scene.analysis.kind);
  check_names(fields, scene);
}

}  // namespace

template <int Dim>
Scene<Dim> read_scene(const std::string& text, const std::string& file, const ShapeLibrary<Dim>& shapes,
                      const std::vector<std::string>& overrides) {
  Scene<Dim> scene;
  read_json(text, file, overrides, [&](Fields& fields) { describe_scene(fields, scene, shapes); });
  return scene;
}

template <int Dim>
void scene_to_json(const Scene<Dim>& scene, nlohmann::ordered_json& json) {
  Scene<Dim> copy = scene;
  write_json([&](Fields& fields) { describe_scene<Dim>(fields, copy, {}); }, json);
}

template <int Dim>
std::string document_scene(const ShapeLibrary<Dim>& shapes) {
  Scene<Dim> defaults;
  return document_fields([&](Fields& fields) { describe_scene(fields, defaults, shapes); });
}

template Scene<2> read_scene<2>(const std::string&, const std::string&, const ShapeLibrary<2>&, const std::vector<std::string>&);
template Scene<3> read_scene<3>(const std::string&, const std::string&, const ShapeLibrary<3>&, const std::vector<std::string>&);
template void scene_to_json<2>(const Scene<2>&, nlohmann::ordered_json&);
template void scene_to_json<3>(const Scene<3>&, nlohmann::ordered_json&);
template std::string document_scene<2>(const ShapeLibrary<2>&);
template std::string document_scene<3>(const ShapeLibrary<3>&);

}  // namespace sem
