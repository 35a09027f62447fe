#include "src3d/shapes/shape_fields.h"

#include "sem/scene/files.h"
#include "src3d/shapes/box.h"

namespace sem::shapes3d {
namespace {

constexpr int max_parts = 1000;

void describe(Fields& fields, Box& box) {
  fields.vector<3>("lower", box.lower, "m", "box: lowest corner");
  fields.vector<3>("upper", box.upper, "m", "box: highest corner, more than 'lower' in x, y and z");
  for (int a = 0; a < 3; ++a)
    if (!(box.lower[a] < box.upper[a]))
      fields.reject("upper", exact_text(box.upper[a]) + " for " + DimTraits<3>::axis_name[a],
                    "more than that of 'lower', " + exact_text(box.lower[a]));
  std::vector<int> counts(box.n_parts.begin(), box.n_parts.end());
  fields.integers("parts", counts, 1, "box: equal parts along x, y and z");
  if (counts.size() != 3)
    fields.reject("parts", std::to_string(counts.size()) + " counts", "3, for x, y and z");
  for (int a = 0; a < 3; ++a) {
    box.n_parts[a] = counts[a];
    if (counts[a] > max_parts)
      fields.reject("parts", std::to_string(counts[a]), "at most " + std::to_string(max_parts));
  }
  fields.integer("degree", box.degree, 1, 9, "box: NURBS degree of the patches");
}

}  // namespace

void describe_shape(Fields& fields, std::vector<ScenePart<3>>& parts) {
  int type = 0;
  fields.require("type");
  fields.option("type", type, {"box"}, "which shape");
  Box box;
  describe(fields, box);
  if (!fields.reading()) return;
  for (auto& part : make_parts(box)) parts.push_back(std::move(part));
}

}  // namespace sem::shapes3d
