#pragma once
// A run of a solver: its answer and what it took.

namespace sem::figures {

struct Measured {
  double unknowns, value;        ///< value: NaN if the run failed
  double preparation, solution;  ///< s, of one thread

  double seconds() const { return preparation + solution; }
};

/// The fastest of up to four runs, one if they are long.
template <class Run>
Measured fastest(const Run& run) {
  Measured best = run();
  double spent = best.seconds();
  for (int i = 1; i < 4 && spent < 0.1; ++i) {
    const Measured next = run();
    spent += next.seconds();
    if (next.seconds() < best.seconds()) best = next;
  }
  return best;
}

}  // namespace sem::figures
