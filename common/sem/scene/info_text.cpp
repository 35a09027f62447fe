#include "sem/scene/info_text.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "sem/base/text_lines.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;

constexpr int parts_shown = 40, stages_shown = 3;

class InfoText {
 public:
  InfoText(const Json& info, int dim) : info_(info), volume_(dim == 2 ? "area" : "volume"), dim_(dim) {}

  std::string text() {
    scene();
    body();
    doubts();
    points();
    unknowns();
    cost();
    parts();
    text_ += "Every figure, the moments and all settings: --json.\n";
    return text_;
  }

 private:
  template <class... Values>
  void add(const char* format, const Values&... values) {
    append_formatted(text_, format, values...);
  }

  double number(const char* key) const { return info_[key].get<double>(); }
  int count(const char* key) const { return info_[key].get<int>(); }
  static std::string name(const Json& json) { return json.get<std::string>(); }

  void scene() {
    const Json &settings = info_["settings"], &method = settings["method"];
    text_ += name(info_["name"]) + ": " + name(settings["description"]) + "\n";
    add("method:    %s, degree %d, quadrature %s; %s\n", name(method["formulation"]).c_str(), method["degree"].get<int>(),
        name(method["quadrature"]["method"]).c_str(), name(settings["analysis"]["type"]).c_str());
  }

  void body() {
    const Json& rule = info_["accuracy"]["quadrature"]["rule"];
    add("body:      %d parts in %d solid%s, boundary %.6g %s, %s %.6g %s, mass %.6g kg\n", count("parts"), count("solids"),
        count("solids") == 1 ? "" : "s", number(dim_ == 2 ? "boundary_length_m" : "boundary_area_m2"), dim_ == 2 ? "m" : "m^2", volume_,
        rule[volume_].get<double>(), dim_ == 2 ? "m^2" : "m^3", number("mass_kg"));
    int k = 0;
    if (info_.contains("shells"))
      for (const auto& shell : info_["shells"]) {
        if (++k > parts_shown) continue;
        add("shell %-3d  %d parts of %s, %s, depth %d\n", k, shell["parts"].get<int>(), name(shell["solid"]).c_str(),
            shell["closed"].get<bool>() ? "closed" : "open", shell["depth"].get<int>());
      }
    more(k);
  }

  void more(int n) {
    if (n > parts_shown) add("           and %d more\n", n - parts_shown);
  }

  void doubts() {
    std::vector<std::string> found;
    const auto doubt = [&](int n, const std::string& what) {
      if (n > 0) found.push_back(std::to_string(n) + " " + what);
    };
    doubt(count("parts_of_undecided_orientation"), "parts of undecided orientation");
    doubt(count("free_edges"), "free edges");
    char gaps[60];
    std::snprintf(gaps, sizeof gaps, "gaps at joints, %.2g m at most", number("longest_gap_m"));
    doubt(count("gaps"), gaps);
    doubt(count("rays_unpaired"), "rays with a hit that found no partner");
    text_ += "doubts:    ";
    for (size_t k = 0; k < found.size(); ++k) text_ += (k > 0 ? "; " : "") + found[k];
    text_ += found.empty() ? "none\n" : "\n";
  }

  void points() {
    const Json &accuracy = info_["accuracy"], &quadrature = accuracy["quadrature"];
    add("points:    %d on or between %d rays; ", count("quadrature_points"), count("rays"));
    if (quadrature.contains("relative_error"))
      add("against the boundary's integrals %s off by %.2g, moments to degree 6 by %.2g\n", volume_,
          quadrature["relative_error"][volume_].get<double>(),
          quadrature["relative_error"]["moments_to_degree_6"].get<double>());
    else
      add("%s not checked (parts overlap, or leave gaps)\n", volume_);
    add("weights:   cutoff %.4g m", number("cutoff_m"));
    if (count("joint_patches") > 0) add(", %d joint patches", count("joint_patches"));
    if (count("layers") > 0) add(", %d layers", count("layers"));
    add(", %.3g %% non-zero; %.2g %% of the %s out of reach\n",
        100 * number("weights_nonzero_share"), 100 * accuracy["uncovered_share"].get<double>(), volume_);
  }

  void unknowns() {
    add("unknowns:  %d, %d more are pinned", count("unknowns"), count("pinned"));
    const Json& condition = info_["condition_estimate"];
    if (condition.is_object())
      for (const auto& [matrix, value] : condition.items())
        add("; condition of the %s %s", matrix == "stiffness" ? "stiffness" : "step's matrix",
            value.is_number() ? shortened(value.get<double>()).c_str() : name(value).c_str());
    else
      add("; condition %s", name(condition).c_str());
    add("; %.3g MB\n", number("memory_MB"));
  }

  static std::string shortened(double value) {
    char text[30];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
  }

  void cost() {
    std::vector<std::pair<double, std::string>> stages;
    double sum = 0;
    for (const auto& [stage, cost] : info_["stages"].items()) {
      stages.push_back({cost["seconds"].get<double>(), stage});
      sum += stages.back().first;
    }
    std::sort(stages.rbegin(), stages.rend());
    add("prepared:  in %.2g s", sum);
    for (int k = 0; k < std::min(stages_shown, int(stages.size())); ++k)
      add("%s%s %.2g", k > 0 ? ", " : ", of which ", stages[k].second.c_str(), stages[k].first);
    text_ += '\n';
    const Json& predicted = info_["predicted"];
    text_ += "predicted: ";
    if (predicted.contains("analysis_seconds"))
      add("analysis %.2g s (%g factorisations); ", predicted["analysis_seconds"].get<double>(),
          predicted["factorizations"].get<double>());
    const Json& error = predicted["relative_error_of_linear_response"];
    text_ += "largest error of the linear response ";
    if (error.is_number())
      add("%.2g %%\n", 100 * error.get<double>());
    else
      text_ += name(error) + "\n";
  }

  void parts() {
    const Json& list = info_["part_list"];
    const char* measure = dim_ == 2 ? "length_m" : "area_m2";
    size_t width = 4;
    for (const auto& part : list) width = std::max(width, title(part).size());
    width = std::min<size_t>(width, 40);
    add("\n%-*s  %12s  %s\n", int(width), "part", measure, dim_ == 2 ? "normal" : "trim loops  normal");
    int k = 0;
    for (const auto& part : list) {
      if (++k > parts_shown) continue;
      const int side = part["orientation"].get<int>();
      add("%-*s  %12.6g  ", int(width), title(part).c_str(), part[measure].get<double>());
      if (dim_ == 3) add("%10d  ", part["trim_loops"].get<int>());
      text_ += side == 0 ? "undecided\n" : side > 0 ? "outward\n" : "inward\n";
    }
    more(k);
    text_ += '\n';
  }

  static std::string title(const Json& part) { return name(part["solid"]) + "/" + name(part["name"]); }

  const Json& info_;
  const char* volume_;
  int dim_;
  std::string text_;
};

}  // namespace

std::string info_text(const Json& info, int dim) { return InfoText(info, dim).text(); }

}  // namespace sem
