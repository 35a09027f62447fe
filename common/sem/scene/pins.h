#pragma once
// What the pins of a scene hold, how they hold it, and where they lead it.

#include <array>
#include <set>

#include "sem/mechanics/clamps.h"
#include "sem/scene/selection.h"
#include "sem/solve/statics.h"

namespace sem {

/// What a pin holds.
struct Held {
  std::vector<int> controls;  ///< control points, ascending
  std::vector<int> entries;   ///< of z, ascending: the reactions on them add up to the pin's force
};

/// The pins of a scene on its body. Projected: the held components of the control points' unknowns are prescribed.
/// Condensed: a pin's displacement d(X) = d0 + D (X - center) becomes columns of z (D if it turns), prescribed in
/// all components, and clamps hold the map to it (clamps.h).
template <int Dim>
class Pins {
 public:
  /// Appends the pins' own columns to d.unknowns if condensed. Keeps references to scene and d. Throws InputError(file, ...)
  /// for a pin that matches nothing and if nothing is left free.
  Pins(const Scene<Dim>& scene, std::vector<PartInfo> parts, const std::string& file, Discretization<Dim>& d);

  /// Per pin.
  const std::vector<Held>& held() const { return held_; }
  /// Nodes of z that are held in all components, ascending.
  std::vector<int> held_nodes() const;
  /// Entries of z that no pin holds, ascending.
  std::vector<int> free_entries() const;
  /// What holds the map where pins hold the boundary; empty unless condensed. A pin holds the boundary where it holds
  /// all control points that it depends on, and by a spring those of its control points that neither lie nor coincide
  /// with one there.
  Clamps<Dim> clamps() const;
  /// z with the pins where they are led.
  Eigen::VectorXd target(const Eigen::VectorXd& rest) const;
  /// Of the pins to there by the load factor; empty if none turns.
  PinPath path(const Eigen::VectorXd& rest) const;
  /// Of the pins to there in time (Pin::duration); empty if none moves so.
  PinPath motion(const Eigen::VectorXd& rest) const;

 private:
  struct HeldSample {
    int sample, pin;
  };
  // A column of z that a pin holds, and leads: it moves by displaced * displacement + (R - I) arm.
  struct HeldColumn {
    int column;
    Pin<Dim> pin;
    std::array<bool, Dim> axes;  // held components
    Vec<Dim> arm;
    double displaced;
  };

  bool condensed() const { return scene_.method.formulation == Formulation::condensed; }
  std::vector<HeldColumn> held_columns(int pin) const;
  std::vector<std::array<bool, Dim>> held_components() const;
  std::vector<HeldColumn> moving_columns() const;
  template <class Share>
  static Eigen::VectorXd led_to(const Eigen::VectorXd& rest, const std::vector<HeldColumn>& moving, const Share& share);
  std::set<int> hold_samples(const Samples<Dim>& samples, int pin, std::vector<HeldSample>& out) const;
  ClampedPoints<Dim> clamped_points(const BoundaryRule<Dim>& rule, const std::vector<HeldSample>& held) const;
  Eigen::RowVectorXd pin_row(int pin, const Vec<Dim>& X) const;
  void subtract_pins(const std::vector<HeldSample>& held, const Points<Dim>& position, MapBlock<Dim>& block) const;
  double depth_below(const Vec<Dim>& X, const Vec<Dim>& normal) const;
  double patch_size(const Vec<Dim>& X) const;
  HeldControl<Dim> spring(int control, int pin) const;
  Vec<Dim> held_axes(int pin) const;
  int part_of_control(int control) const;

  const Scene<Dim>& scene_;
  const std::vector<PartInfo> parts_;
  const Discretization<Dim>& d_;
  std::vector<Held> held_;
  std::vector<int> first_column_;  // condensed, per pin
};

}  // namespace sem
