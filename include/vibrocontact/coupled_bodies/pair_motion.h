#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <vector>

namespace vibrocontact
{
  /// What moves without the contact: x' = transition x + (0, input R), x = (q, v, Re z, Im z, s), of which forces do not
  /// move the first n_modes, q, at once,
  ///
  ///   du = displacement x + W R,     du' = (rate + rest_rate) x + (rate_at_once + rest_rate_at_once) R + W R'
  ///
  /// The rates of rests that relax stand by themselves: friction that depends on the slip speed does not see them.
  struct PairMotion
  {
    DenseMatrix transition, input, displacement, rate, rate_at_once, rest_rate, rest_rate_at_once;
  };

  /// The directions in which a frame has forces: normal, across and along the slip; 3 n x n_forces. The states s of rests that
  /// relax stay in their span.
  DenseMatrix span_of_forces(const SlidingFrame &frame, unsigned int n);
  /// Coordinates of forces in their span; n_forces x 3 n.
  DenseMatrix shares_in(const DenseMatrix &forces);

  /// @param rests of the pair, those that relax @param forces span_of_forces(); 3 n x n_forces
  PairMotion pair_motion(const ContactPair &pair, const std::vector<RelaxingRest> &rests,
                         const DenseMatrix &forces);

  /// What of W follows forces at once, W less what relaxes: nothing in rows where only rounding is left.
  DenseMatrix at_once(const DenseMatrix &W, const std::vector<RelaxingRest> &rests);
  /// Places of the directions along which something follows forces at once. @param W at_once()
  std::vector<unsigned int> followed_at_once(const DenseMatrix &W,
                                             const std::vector<ContactDirection> &directions, unsigned int n);
} // namespace vibrocontact
