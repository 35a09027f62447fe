// Checkpoints: every bit comes back, and nothing but the whole file is accepted.
#include <cmath>

#include "errors.h"
#include "folder.h"
#include "sem/scene/checkpoint.h"

using namespace sem;

namespace {

Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.settings = fingerprint("settings");
  checkpoint.state.z = Eigen::Vector4d(0.1, -0.0, 1e-310, 1.0 / 3);
  checkpoint.state.v = Eigen::Vector4d(1, 2, 3, -1e300);
  checkpoint.state.time = 0.1 + 0.2;
  checkpoint.state.step = 123456789012;
  checkpoint.columns = {"step", "time, s", ""};
  checkpoint.history = {{1, 2, 3}, {4, std::nan(""), 6}};  // a probe may have no value
  return checkpoint;
}

std::string reading_error(const std::string& path) {
  return test::error_of([&] { read_checkpoint(path, fingerprint("settings")); });
}

}  // namespace

TEST_CASE("checkpoint: written and read it has the same bits") {
  const test::Folder folder("checkpoint_bits");
  const std::string path = folder / "checkpoint.bin";
  const Checkpoint saved = example();
  write_checkpoint(path, saved);
  const Checkpoint read = read_checkpoint(path, saved.settings);
  CHECK(read.settings == saved.settings);
  CHECK(read.state.z == saved.state.z);
  CHECK(std::signbit(read.state.z[1]));
  CHECK(read.state.v == saved.state.v);
  CHECK(read.state.time == saved.state.time);
  CHECK(read.state.step == saved.state.step);
  CHECK(read.columns == saved.columns);
  CHECK(read.history[0] == saved.history[0]);
  CHECK(std::isnan(read.history[1][1]));
  write_checkpoint(folder / "again.bin", read);
  CHECK(test::content(folder / "again.bin") == test::content(path));
}

TEST_CASE("checkpoint: cut at any length it is rejected") {
  const test::Folder folder("checkpoint_cut");
  write_checkpoint(folder / "whole", example());
  const std::string whole = test::content(folder / "whole");
  for (size_t length = 0; length < whole.size(); ++length) {
    test::write(folder / "cut", whole.substr(0, length));
    const std::string error = reading_error(folder / "cut");
    CAPTURE(length);
    CHECK(error.starts_with((folder / "cut") + ": "));
  }
  test::write(folder / "cut", whole + "x");
  test::check_names(reading_error(folder / "cut"), folder / "cut", {"damaged"});
}

TEST_CASE("checkpoint: with any byte changed it is rejected") {
  const test::Folder folder("checkpoint_flip");
  write_checkpoint(folder / "whole", example());
  const std::string whole = test::content(folder / "whole");
  for (size_t at = 0; at < whole.size(); ++at)
    for (const int bit : {0, 3, 7}) {
      std::string damaged = whole;
      damaged[at] = char(damaged[at] ^ (1 << bit));
      test::write(folder / "damaged", damaged);
      CAPTURE(at);
      CHECK(!reading_error(folder / "damaged").empty());
    }
}

TEST_CASE("checkpoint: a checksum that fits does not make nonsense acceptable") {
  const test::Folder folder("checkpoint_nonsense");
  const std::string path = folder / "checkpoint.bin";
  const auto error_of_bad = [&](const Checkpoint& bad) {
    write_checkpoint(path, bad);
    return reading_error(path);
  };
  Checkpoint bad = example();
  bad.state.v.resize(3);
  bad.state.v.setZero();
  test::check_names(error_of_bad(bad), path, {"damaged"});
  bad = example();
  bad.state.z[2] = std::nan("");
  test::check_names(error_of_bad(bad), path, {"damaged"});
  bad = example();
  bad.state.step = -1;
  test::check_names(error_of_bad(bad), path, {"damaged"});
  bad = example();
  bad.history[1].pop_back();
  test::check_names(error_of_bad(bad), path, {"damaged"});
  // A count that no file has room for.
  std::string body(8, '\0');
  body[7] = 0x7F;
  test::write(path, "sem checkpoint 1\n" + fingerprint(body) + "\n" + body);
  test::check_names(reading_error(path), path, {"damaged"});
}

TEST_CASE("checkpoint: of other settings, of another version, or missing") {
  const test::Folder folder("checkpoint_other");
  const std::string path = folder / "checkpoint.bin";
  test::check_names(reading_error(path), path, {"no readable file"});
  write_checkpoint(path, example());
  test::check_names(test::error_of([&] { read_checkpoint(path, fingerprint("others")); }), path,
                    {"settings", "other settings"});
  std::string later = test::content(path);
  later.replace(later.find(" 1\n"), 3, " 2\n");
  test::write(path, later);
  test::check_names(reading_error(path), path, {"version"});
  test::write(path, "");
  test::check_names(reading_error(path), path, {"no checkpoint"});
}

TEST_CASE("fingerprint: FNV-1a of 64 bits") {
  CHECK(fingerprint("") == "cbf29ce484222325");   // the offset basis
  CHECK(fingerprint("a") == "af63dc4c8601ec8c");  // published test vector
}
