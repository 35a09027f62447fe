#pragma once
// What a computation costs: counted from sizes before it runs, measured while it does.

#include <utility>

#include "sem/base/stopwatch.h"

namespace sem {

/// Counted. Matrix products and factors alone: what is done point by point (materials) or sample by sample is left
/// out, so the time that it takes on a given machine is a lower bound.
struct Work {
  double flops = 0;  ///< additions and multiplications
  double bytes = 0;  ///< of the matrices, each read or written once
  Work& operator+=(const Work& other) {
    flops += other.flops;
    bytes += other.bytes;
    return *this;
  }
};

/// A kind of computation that a solver repeats.
struct Task {
  long n = 0;
  double seconds = 0;
  Work work;  ///< of all of them

  /// Calls `compute`, whose work is known, and adds it.
  template <class Compute>
  decltype(auto) run(const Work& once, Compute&& compute) {
    struct Entry {
      Task& task;
      Stopwatch watch;
      ~Entry() { task.seconds += watch.seconds(); }
    } entry{*this, {}};
    ++n;
    work += once;
    return std::forward<Compute>(compute)();
  }
  Task& operator+=(const Task& other) {
    n += other.n;
    seconds += other.seconds;
    work += other.work;
    return *this;
  }
};

/// Of the calls of a Potential (system.h).
struct PotentialWork {
  Work energy, gradient, hessian;
};

/// What a solver has spent over its life.
struct Counters {
  Task energies, gradients, hessians;
  Task factorizations;         ///< attempted ones
  Task solves;                 ///< of triangular systems, forward and back
  long n_psd_projections = 0;  ///< Hessians projected because the raw one was indefinite
  long n_shifts = 0;           ///< multiples of the diagonal added because that did not do either

  Counters& operator+=(const Counters& other) {
    energies += other.energies;
    gradients += other.gradients;
    hessians += other.hessians;
    factorizations += other.factorizations;
    solves += other.solves;
    n_psd_projections += other.n_psd_projections;
    n_shifts += other.n_shifts;
    return *this;
  }
};

}  // namespace sem
