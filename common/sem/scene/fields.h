#pragma once
// One description of a struct's fields serves three purposes: reading JSON,
// writing it back with all defaults filled in, and documenting the schema.
//
//   void describe(Fields& fields, Material& m) {
//     fields.number("density", m.density, at_least(0), "kg/m^3", "mass per rest volume");
//   }

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// Numbers that a field takes.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false, upper_open = false;

  bool contains(double value) const;
  std::string text() const;  ///< "a number > 0"
};
inline const Range any_number{};
inline const Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline Range at_least(double lower) { return {lower}; }
inline Range between(double lower, double upper) { return {lower, upper}; }
inline Range inside_of(double lower, double upper) { return {lower, upper, true, true}; }

/// A visitor of fields. A key that is absent leaves the value as it is.
class Fields {
 public:
  using Body = std::function<void(Fields&)>;
  using ItemBody = std::function<void(Fields&, int)>;
  virtual ~Fields() = default;

  virtual void number(const char* key, double& value, const Range& range, const char* unit,
                      const char* meaning) = 0;
  virtual void integer(const char* key, int& value, int lower, int upper, const char* meaning) = 0;
  virtual void boolean(const char* key, bool& value, const char* meaning) = 0;
  virtual void text(const char* key, std::string& value, const char* meaning) = 0;
  /// One of the names; value is its index.
  virtual void option(const char* key, int& value, const std::vector<std::string>& names,
                      const char* meaning) = 0;
  /// A list of numbers; of exactly `size` if that is not 0.
  virtual void numbers(const char* key, std::vector<double>& values, int size, const Range& range,
                       const char* unit, const char* meaning) = 0;
  virtual void integers(const char* key, std::vector<int>& values, int lower, const char* meaning) = 0;
  /// A list of rows of `width` numbers each, row after row in values.
  virtual void rows(const char* key, std::vector<double>& values, int width, const char* unit,
                    const char* meaning) = 0;
  virtual void object(const char* key, const char* meaning, const Body& body) = 0;
  /// A list of objects: resize(n) is called before the items when reading.
  virtual void list(const char* key, const char* meaning, int size,
                    const std::function<void(int)>& resize, const ItemBody& item) = 0;

  /// Whether to visit an optional field: reading: the key is there; writing:
  /// `present`; documenting: always.
  virtual bool optional(const char* key, bool present) = 0;
  /// The key has to be there. Throws InputError when reading if it is not.
  virtual void require(const char* key) = 0;
  /// Reports bad input at a key (nullptr: at the object itself) while reading; ignored otherwise.
  virtual void reject(const char* key, const std::string& found, const std::string& allowed) = 0;
  /// True while reading (else writing or documenting).
  virtual bool reading() const = 0;
  /// True while documenting: every alternative is to be described.
  virtual bool documenting() const = 0;
  /// "file" of the errors and the path of the object or of a key in it, "solids[0].material".
  virtual std::string file() const = 0;
  virtual std::string path(const char* key = nullptr) const = 0;

  // In terms of the above.
  template <class Enum>
  void choice(const char* key, Enum& value, const std::vector<std::string>& names, const char* meaning) {
    int index = int(value);
    option(key, index, names, meaning);
    value = Enum(index);
  }
  template <int Dim>
  void vector(const char* key, Vec<Dim>& value, const char* unit, const char* meaning) {
    std::vector<double> values(value.begin(), value.end());
    numbers(key, values, Dim, any_number, unit, meaning);
    for (int a = 0; a < Dim; ++a) value[a] = values[a];
  }
  template <int Dim>
  void points(const char* key, Points<Dim>& value, const char* unit, const char* meaning) {
    std::vector<double> values(value.data(), value.data() + value.size());
    rows(key, values, Dim, unit, meaning);
    value = Eigen::Map<const Points<Dim>>(values.data(), Dim, Eigen::Index(values.size()) / Dim);
  }
  template <class Item>
  void items(const char* key, std::vector<Item>& values, const char* meaning,
             const std::function<void(Fields&, Item&)>& describe) {
    if (documenting()) values.resize(1);
    list(key, meaning, int(values.size()), [&](int n) { values.resize(n); },
         [&](Fields& fields, int i) { describe(fields, values[i]); });
  }
};

/// The name among `names` closest to `word` (edit distance), empty if none is close.
std::string closest_name(const std::string& word, const std::vector<std::string>& names);

/// Reads the fields of a JSON object in a text with comments. Strict: duplicate
/// and unknown keys, wrong types and values out of range are InputErrors that
/// name file, field, found and allowed. `overrides` are key=value pairs,
/// "analysis.time_step=0.005" or "solids[0].material.density=10", applied first.
void read_json(const std::string& text, const std::string& file,
               const std::vector<std::string>& overrides, const Fields::Body& body);

/// The described fields as a table for people: key, type, unit, default, meaning.
std::string document_fields(const Fields::Body& body);

}  // namespace sem
