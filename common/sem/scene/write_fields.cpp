// Fields, writing and documenting.
#include <nlohmann/json.hpp>

#include "sem/scene/fields.h"
#include "sem/scene/files.h"
#include "sem/scene/json_text.h"
#include "sem/scene/read_scene.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;

class FieldWriter : public Fields {
 public:
  Json json = Json::object();

  void number(const char* key, double& value, const Range&, const char*, const char*) override { json[key] = value; }
  void integer(const char* key, int& value, int, int, const char*) override { json[key] = value; }
  void boolean(const char* key, bool& value, const char*) override { json[key] = value; }
  void text(const char* key, std::string& value, const char*) override { json[key] = value; }
  void option(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    json[key] = names[value];
  }
  void numbers(const char* key, std::vector<double>& values, int, const Range&, const char*, const char*) override {
    json[key] = values;
  }
  void integers(const char* key, std::vector<int>& values, int, const char*) override { json[key] = values; }
  void rows(const char* key, std::vector<double>& values, int width, const char*, const char*) override {
    json[key] = Json::array();
    for (size_t i = 0; i < values.size(); i += width)
      json[key].push_back(std::vector<double>(values.begin() + i, values.begin() + i + width));
  }
  void object(const char* key, const char*, const Body& body) override {
    FieldWriter writer;
    body(writer);
    json[key] = std::move(writer.json);
  }
  void list(const char* key, const char*, int size, const std::function<void(int)>&, const ItemBody& item) override {
    json[key] = Json::array();
    for (int i = 0; i < size; ++i) {
      FieldWriter writer;
      item(writer, i);
      json[key].push_back(std::move(writer.json));
    }
  }
  bool optional(const char*, bool present) override { return present; }
  void require(const char*) override {}
  void reject(const char*, const std::string&, const std::string&) override {}
  bool reading() const override { return false; }
  bool documenting() const override { return false; }
  std::string file() const override { return ""; }
  std::string path(const char* key) const override { return key ? key : ""; }
};

// A line per field, indented by depth.
class FieldDocumenter : public Fields {
 public:
  std::string lines;

  explicit FieldDocumenter(int depth) : depth_(depth) {}

  void number(const char* key, double& value, const Range& range, const char* unit, const char* meaning) override {
    line(key, range.text() + units(unit), exact_text(value), meaning);
  }
  void integer(const char* key, int& value, int lower, int upper, const char* meaning) override {
    line(key, "an integer " + (upper == 1 << 30 ? ">= " + std::to_string(lower)
                                                : std::to_string(lower) + " to " + std::to_string(upper)),
         std::to_string(value), meaning);
  }
  void boolean(const char* key, bool& value, const char* meaning) override {
    line(key, "true or false", value ? "true" : "false", meaning);
  }
  void text(const char* key, std::string& value, const char* meaning) override {
    line(key, "a text", value.empty() ? "" : '"' + value + '"', meaning);
  }
  void option(const char* key, int& value, const std::vector<std::string>& names, const char* meaning) override {
    std::string all;
    for (const auto& name : names) all += (all.empty() ? "" : " | ") + name;
    line(key, all, names[value], meaning);
  }
  void numbers(const char* key, std::vector<double>& values, int size, const Range&, const char* unit,
               const char* meaning) override {
    line(key, size > 0 ? std::to_string(size) + " numbers" + units(unit) : "a list of numbers" + units(unit),
         values.empty() ? "" : Json(values).dump(), meaning);
  }
  void integers(const char* key, std::vector<int>& values, int, const char* meaning) override {
    line(key, "a list of integers", values.empty() ? "" : Json(values).dump(), meaning);
  }
  void rows(const char* key, std::vector<double>&, int width, const char* unit, const char* meaning) override {
    line(key, "a list of lists of " + std::to_string(width) + " numbers" + units(unit), "", meaning);
  }
  void object(const char* key, const char* meaning, const Body& body) override {
    line(key, "an object", "", meaning);
    nested(body);
  }
  void list(const char* key, const char* meaning, int, const std::function<void(int)>& resize,
            const ItemBody& item) override {
    line(key, "a list of objects", "", meaning);
    resize(1);
    nested([&](Fields& fields) { item(fields, 0); });
  }
  bool optional(const char*, bool) override { return true; }
  void require(const char* key) override { required_ = key; }
  void reject(const char*, const std::string&, const std::string&) override {}
  bool reading() const override { return false; }
  bool documenting() const override { return true; }
  std::string file() const override { return ""; }
  std::string path(const char* key) const override { return key ? key : ""; }

 private:
  static std::string units(const char* unit) { return *unit ? std::string(", ") + unit : ""; }

  void nested(const Body& body) {
    FieldDocumenter inner(depth_ + 1);
    body(inner);
    lines += inner.lines;
  }

  void line(const std::string& key, const std::string& type, const std::string& preset, const char* meaning) {
    lines += std::string(2 * depth_, ' ') + key + ": " + type;
    if (required_ == key)
      lines += "; required";
    else if (!preset.empty())
      lines += "; default " + preset;
    lines += "\n" + std::string(2 * depth_ + 6, ' ') + meaning + "\n";
    required_.clear();
  }

  int depth_;
  std::string required_;
};

bool is_flat(const Json& json) {
  if (!json.is_array()) return false;
  for (const auto& entry : json)
    if (entry.is_structured()) return false;
  return true;
}

void append(const Json& json, int indent, std::string& out) {
  if (!json.is_structured() || json.empty() || is_flat(json)) {
    out += json.dump(-1, ' ', false, Json::error_handler_t::replace);  // names may be no UTF-8
    return;
  }
  const std::string margin(indent + 2, ' ');
  out += json.is_array() ? "[\n" : "{\n";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    if (!first) out += ",\n";
    first = false;
    out += margin;
    if (json.is_object()) out += Json(key).dump() + ": ";
    append(value, indent + 2, out);
  }
  out += "\n" + std::string(indent, ' ') + (json.is_array() ? "]" : "}");
}

}  // namespace

std::string json_text(const Json& json) {
  std::string out;
  append(json, 0, out);
  return out + "\n";
}

void write_json(const Fields::Body& body, Json& json) {
  FieldWriter writer;
  body(writer);
  json = std::move(writer.json);
}

template <int Dim>
std::string write_scene(const Scene<Dim>& scene) {
  Json json;
  scene_to_json(scene, json);
  return json_text(json);
}

template std::string write_scene<2>(const Scene<2>&);
template std::string write_scene<3>(const Scene<3>&);

std::string document_fields(const Fields::Body& body) {
  FieldDocumenter documenter(0);
  body(documenter);
  return documenter.lines;
}

}  // namespace sem
