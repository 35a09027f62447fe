// Fields, reading.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <cctype>
#include <set>

#include "sem/base/error.h"
#include "sem/scene/fields.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;

// Powers of what is larger overflow.
constexpr double largest_number = 1e30;

// A value as it stands in the file, shortened.
std::string shown(const Json& value) {
  std::string text = value.dump();
  if (text.size() <= 60) return text;
  size_t end = 57;
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // not inside a UTF-8 character
  return text.substr(0, end) + "...";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

class FieldReader : public Fields {
 public:
  FieldReader(const Json& object, const std::string& file, std::string path)
      : object_(object), file_(file), path_(std::move(path)) {
    if (!object.is_object()) throw InputError(file_, path_, shown(object), "an object { ... }");
  }

  void number(const char* key, double& value, const Range& range, const char*, const char*) override {
    if (const Json* found = find(key)) value = checked_number(*found, path(key), range);
  }

  void integer(const char* key, int& value, int lower, int upper, const char*) override {
    if (const Json* found = find(key)) value = checked_integer(*found, path(key), lower, upper);
  }

  void boolean(const char* key, bool& value, const char*) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_boolean()) throw InputError(file_, path(key), shown(*found), "true or false");
    value = found->get<bool>();
  }

  void text(const char* key, std::string& value, const char*) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_string()) throw InputError(file_, path(key), shown(*found), "a text in quotes");
    value = found->get<std::string>();
  }

  void option(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_string()) throw InputError(file_, path(key), shown(*found), "one of " + joined(names));
    const std::string word = found->get<std::string>();
    const auto at = std::find(names.begin(), names.end(), word);
    if (at == names.end()) throw InputError(file_, path(key), "'" + word + "'", suggestion(word, names));
    value = int(at - names.begin());
  }

  void numbers(const char* key, std::vector<double>& values, int size, const Range& range, const char*,
               const char*) override {
    const Json* found = find(key);
    if (!found) return;
    const std::string wanted =
        size > 0 ? "a list of " + std::to_string(size) + " numbers" : "a list of numbers";
    if (!found->is_array() || (size > 0 && found->size() != size_t(size)))
      throw InputError(file_, path(key), shown(*found), wanted);
    values.clear();
    for (size_t i = 0; i < found->size(); ++i)
      values.push_back(checked_number((*found)[i], item_path(key, i), range));
  }

  void integers(const char* key, std::vector<int>& values, int lower, const char*) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_array()) throw InputError(file_, path(key), shown(*found), "a list of integers");
    values.clear();
    for (size_t i = 0; i < found->size(); ++i)
      values.push_back(checked_integer((*found)[i], item_path(key, i), lower, 1 << 30));
  }

  void rows(const char* key, std::vector<double>& values, int width, const char*, const char*) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_array())
      throw InputError(file_, path(key), shown(*found), "a list of lists of " + std::to_string(width) + " numbers");
    values.clear();
    for (size_t i = 0; i < found->size(); ++i) {
      const Json& row = (*found)[i];
      if (!row.is_array() || row.size() != size_t(width))
        throw InputError(file_, item_path(key, i), shown(row), "a list of " + std::to_string(width) + " numbers");
      for (const Json& entry : row) values.push_back(checked_number(entry, item_path(key, i), any_number));
    }
  }

  void object(const char* key, const char*, const Body& body) override {
    if (const Json* found = find(key)) visit(*found, path(key), body);
  }

  void list(const char* key, const char*, int, const std::function<void(int)>& resize,
            const ItemBody& item) override {
    const Json* found = find(key);
    if (!found) return;
    if (!found->is_array()) throw InputError(file_, path(key), shown(*found), "a list [ ... ]");
    resize(int(found->size()));
    for (size_t i = 0; i < found->size(); ++i)
      visit((*found)[i], item_path(key, i), [&](Fields& fields) { item(fields, int(i)); });
  }

  bool optional(const char* key, bool) override { return find(key) != nullptr; }

  void require(const char* key) override {
    if (find(key)) return;
    std::vector<std::string> others;
    for (const auto& [other, value] : object_.items())
      if (!known_.count(other)) others.push_back(other);
    const std::string close = closest_name(key, others);
    throw InputError(file_, path(key), close.empty() ? "nothing" : "nothing, but '" + close + "'",
                     "this field is required");
  }

  void reject(const char* key, const std::string& found, const std::string& allowed) override {
    throw InputError(file_, path(key), found, allowed);
  }

  bool reading() const override { return true; }
  bool documenting() const override { return false; }
  std::string file() const override { return file_; }
  std::string path(const char* key) const override {
    if (!key) return path_;
    return path_.empty() ? key : path_ + "." + key;
  }

  // After all fields: keys that nobody asked for.
  void check_unknown() const {
    for (const auto& [key, value] : object_.items())
      if (!known_.count(key))
        throw InputError(file_, path_, "the unknown key '" + key + "'",
                         suggestion(key, {known_.begin(), known_.end()}));
  }

  void visit(const Json& value, const std::string& path, const Body& body) const {
    FieldReader reader(value, file_, path);
    body(reader);
    reader.check_unknown();
  }

 private:
  const Json* find(const char* key) {
    known_.insert(key);
    const auto at = object_.find(key);
    return at == object_.end() ? nullptr : &*at;
  }

  std::string item_path(const char* key, size_t i) const { return path(key) + "[" + std::to_string(i) + "]"; }

  static std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
    const std::string close = closest_name(word, names);
    return (close.empty() ? "" : "'" + close + "' (did you mean that?), or ") + "one of " + joined(names);
  }

  double checked_number(const Json& value, const std::string& path, const Range& range) const {
    if (!value.is_number()) throw InputError(file_, path, shown(value), range.text());
    const double number = value.get<double>();
    if (!std::isfinite(number) || !range.contains(number))
      throw InputError(file_, path, shown(value), range.text());
    if (std::abs(number) > largest_number) throw InputError(file_, path, shown(value), range.text() + ", at most 1e30 in size");
    return number;
  }

  int checked_integer(const Json& value, const std::string& path, int lower, int upper) const {
    const std::string wanted = "an integer " + (upper == 1 << 30
                                                    ? ">= " + std::to_string(lower)
                                                    : "from " + std::to_string(lower) + " to " + std::to_string(upper));
    if (!value.is_number_integer()) throw InputError(file_, path, shown(value), wanted);
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(1) << 40;
    const auto number = huge ? std::int64_t(1) << 40 : value.get<std::int64_t>();
    if (number < lower || number > upper) throw InputError(file_, path, shown(value), wanted);
    return int(number);
  }

  const Json& object_;
  const std::string& file_;
  std::string path_;
  std::set<std::string> known_;
};

std::string place(const std::string& text, size_t byte) {
  size_t line = 1, column = 1;
  for (size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') {
      ++line;
      column = 1;
    }
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// Follows the parser through the text: rejects what the parsed value no longer
// shows (a key twice) and nesting that no scene needs.
class Strictness {
 public:
  explicit Strictness(const std::string& file) : file_(file) {}

  void see(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) {
      open_.push_back({event == Event::array_start, 0, "", {}});
      if (open_.size() > 100) throw InputError(file_, path(), "more than 100 levels of brackets", "fewer");
    } else if (event == Event::key) {
      open_.back().key = parsed.get<std::string>();
      if (!open_.back().keys.insert(open_.back().key).second)
        throw InputError(file_, path(), "this key twice in one object", "each key once");
    } else {
      if (event != Event::value) open_.pop_back();
      if (!open_.empty()) ++open_.back().index;
    }
  }

 private:
  struct Level {
    bool is_list;
    size_t index;  // of the item that comes next
    std::string key;
    std::set<std::string> keys;
  };

  std::string path() const {
    std::string path;
    for (const Level& level : open_)
      if (level.is_list)
        path += "[" + std::to_string(level.index) + "]";
      else if (!level.key.empty())
        path += (path.empty() ? "" : ".") + level.key;
    return path;
  }

  const std::string& file_;
  std::vector<Level> open_;
};

Json parse(const std::string& text, const std::string& file) {
  Strictness strictness(file);
  const auto see = [&](int, Json::parse_event_t event, Json& parsed) {
    strictness.see(event, parsed);
    return true;
  };
  const auto fail = [&](const std::string& where, std::string what) {
    const size_t code = what.find("] ");  // "[json.exception...] "
    if (code != std::string::npos) what = what.substr(code + 2);
    const size_t colon = what.find(": ");  // "parse error at line 1, column 2: "
    if (!where.empty() && colon != std::string::npos) what = what.substr(colon + 2);
    throw InputError(file, where, "no valid JSON (" + what + ")", "JSON; comments // and /* */");
  };
  try {
    return Json::parse(text, see, true, true);
  } catch (const Json::parse_error& error) {
    fail(place(text, error.byte), error.what());
  } catch (const Json::exception& error) {  // a number too large
    const std::string what = error.what();
    const size_t open = what.find('\''), close = what.rfind('\'');
    const std::string number = open < close ? what.substr(open + 1, close - open - 1) : "";
    const size_t at = number.empty() ? std::string::npos : text.find(number);
    throw InputError(file, at == std::string::npos ? "" : place(text, at + 1), "the number " + number, "numbers of at most 1e30 in size");
  }
  return {};
}

// "solids[0].material.density" as "solids", "[0", "material", "density": words of letters, digits and
// underscores, indices of at most six digits. Empty if it is no such path.
std::vector<std::string> steps_of_path(const std::string& path) {
  std::vector<std::string> steps;
  size_t at = 0;
  const auto take = [&](auto allowed) {
    const size_t begin = at;
    while (at < path.size() && allowed(path[at])) ++at;
    return path.substr(begin, at - begin);
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (;;) {
    steps.push_back(take(is_word));
    if (steps.back().empty()) return {};
    while (at < path.size() && path[at] == '[') {
      ++at;
      steps.push_back("[" + take(is_digit));
      if (steps.back().size() < 2 || steps.back().size() > 7 || at == path.size() || path[at++] != ']') return {};
    }
    if (at == path.size()) return steps;
    if (path[at++] != '.') return {};
  }
}

// Follows "solids[0].material.density" to the value it names, making objects on the way.
Json& resolve(Json& root, const std::string& path, const std::string& pair) {
  const auto fail = [&](const std::string& found) {
    throw InputError("--set", pair, found, "key=value with the keys of a scene, as in solids[0].material.density=10");
  };
  Json* at = &root;
  const auto steps = steps_of_path(path);
  if (path.size() > 1000 || steps.empty()) fail("'" + path + "', no valid path");
  for (const std::string& key : steps) {
    if (key[0] == '[') {
      const size_t index = std::stoul(key.substr(1));
      if (!at->is_array() || index >= at->size()) fail("index " + std::to_string(index) + ", which is not in the scene");
      at = &(*at)[index];
    } else {
      if (!at->is_object() && !at->is_null()) fail("'" + path + "', where '" + key + "' is no key of an object");
      at = &(*at)[key];
    }
  }
  return *at;
}

void apply_override(Json& root, const std::string& pair) {
  const size_t equals = pair.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("--set", pair, "no key=value", "key=value, as in analysis.time_step=0.005");
  const std::string value = pair.substr(equals + 1);
  Json parsed = Json::parse(value, nullptr, false);
  if (!parsed.is_discarded())
    parsed = parse(value, "--set " + pair);  // strictly
  else  // a bare word is a text; bytes that are no UTF-8 could not be written back
    parsed = Json::parse(Json(value).dump(-1, ' ', false, Json::error_handler_t::replace));
  resolve(root, pair.substr(0, equals), pair) = parsed;
}

}  // namespace

void read_json(const std::string& text, const std::string& file,
               const std::vector<std::string>& overrides, const Fields::Body& body) {
  Json root = parse(text, file);
  if (!root.is_object()) throw InputError(file, "", shown(root), "an object { ... }");
  for (const auto& pair : overrides) apply_override(root, pair);
  FieldReader reader(root, file, "");
  body(reader);
  reader.check_unknown();
}

}  // namespace sem
