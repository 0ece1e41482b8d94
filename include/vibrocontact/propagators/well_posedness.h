#pragma once

#include <vibrocontact/bodies/body_in_contact.h>

#include <array>

namespace vibrocontact
{
  /// Well-posedness of the contact problem with a model: the LCP 0 <= q, u_h + (B + S) q - u_road >= 0 of a step has one
  /// solution if the symmetric part of B + S is positive definite. A good fit does not make it so.
  struct WellPosedness
  {
    /// step, its half and tenth [s]
    std::array<double, 3> steps;
    /// smallest over largest eigenvalue of the symmetric part of B + S at each, the worst of the force interpolations
    std::array<double, 3> definiteness;
    /// the same in the limit of a zero step: of S, and where S has no stiffness of g(0+), or of g'(0+) if g(0+) vanishes
    double limit = 0;
    /// largest |g(0+)| over the largest |g(t)| within a step's reach [-], exactly 0 only if it was imposed
    double initial_value = 0;
    /// g(0+) = 0 and g'(0+) positive definite: rigid points may strike, J = (u_r' - v) / g'(0+) holds
    bool impacts = false;

    bool usable() const;
    /// One sentence about what fails; empty if usable.
    std::string reason() const;
  };

  WellPosedness well_posedness_of_contact(const BodyInContact &model, double step);

  /// @throws InputError with the reason, the name of the body in front, if the model cannot be used at this step
  void check_well_posedness(const BodyInContact &model, double step, const std::string &body);
} // namespace vibrocontact
