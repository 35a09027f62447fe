#include "sem/scene/checkpoint.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "sem/base/error.h"
#include "sem/scene/files.h"

namespace sem {
namespace {

constexpr char magic[] = "sem checkpoint 1\n";

class Writer {
 public:
  std::string bytes;
  void integer(std::int64_t value) { raw(&value, sizeof value); }
  void number(double value) { raw(&value, sizeof value); }
  void text(const std::string& value) {
    integer(std::int64_t(value.size()));
    bytes += value;
  }
  template <class Numbers>
  void numbers(const Numbers& values) {
    integer(std::int64_t(values.size()));
    for (const double value : values) number(value);
  }

 private:
  void raw(const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); }
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  std::int64_t integer() { return raw<std::int64_t>(); }
  double number() { return raw<double>(); }
  std::int64_t count() {
    const std::int64_t n = integer();
    if (n < 0 || n > std::int64_t(bytes_.size())) throw std::out_of_range("count");
    return n;
  }
  std::string text() {
    const auto n = size_t(count());
    need(n);
    at_ += n;
    return bytes_.substr(at_ - n, n);
  }
  std::vector<double> numbers() {
    std::vector<double> values(static_cast<size_t>(count()));
    for (double& value : values) value = number();
    return values;
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  void need(size_t n) const {
    if (n > bytes_.size() - at_) throw std::out_of_range("end of file");
  }
  template <class T>
  T raw() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  const std::string& bytes_;
  size_t at_ = 0;
};

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

Checkpoint parse(const std::string& body) {
  Reader in(body);
  Checkpoint checkpoint;
  checkpoint.settings = in.text();
  checkpoint.state.step = in.integer();
  checkpoint.state.time = in.number();
  checkpoint.state.z = vector(in.numbers());
  checkpoint.state.v = vector(in.numbers());
  for (auto n = in.count(); n > 0; --n) checkpoint.columns.push_back(in.text());
  for (auto n = in.count(); n > 0; --n) {
    checkpoint.history.push_back(in.numbers());
    if (checkpoint.history.back().size() != checkpoint.columns.size()) throw std::out_of_range("row");
  }
  const State& state = checkpoint.state;
  if (!in.at_end() || state.step < 0 || state.z.size() != state.v.size() || !state.z.allFinite() ||
      !state.v.allFinite())
    throw std::out_of_range("state");
  return checkpoint;
}

}  // namespace

std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211u;
  char digits[17];
  snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  Writer out;
  out.text(checkpoint.settings);
  out.integer(checkpoint.state.step);
  out.number(checkpoint.state.time);
  out.numbers(checkpoint.state.z);
  out.numbers(checkpoint.state.v);
  out.integer(std::int64_t(checkpoint.columns.size()));
  for (const auto& column : checkpoint.columns) out.text(column);
  out.integer(std::int64_t(checkpoint.history.size()));
  for (const auto& row : checkpoint.history) out.numbers(row);
  write_file(path, magic + fingerprint(out.bytes) + "\n" + out.bytes);
}

Checkpoint read_checkpoint(const std::string& path, const std::string& settings) {
  const std::string file = read_file(path);
  const size_t head = sizeof magic - 1 + 17;
  if (file.size() < head || !file.starts_with(magic))
    throw InputError(path, "header", "no checkpoint of this version", "a checkpoint of this version of sem");
  const std::string body = file.substr(head);
  if (file.substr(sizeof magic - 1, 17) != fingerprint(body) + "\n")
    throw InputError(path, "checksum", "a damaged checkpoint", "the file as it was written");
  Checkpoint checkpoint;
  try {
    checkpoint = parse(body);
  } catch (const std::out_of_range&) {
    throw InputError(path, "content", "a damaged checkpoint", "the file as it was written");
  }
  if (checkpoint.settings != settings)
    throw InputError(path, "settings", "a checkpoint of other settings (" + checkpoint.settings + ")",
                     "one of this scene (" + settings + "); summary.json beside it has the settings of that run");
  return checkpoint;
}

}  // namespace sem
