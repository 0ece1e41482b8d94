#pragma once

#include <vibrocontact/coupled_bodies/contact_root.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <complex>
#include <map>
#include <vector>

namespace vibrocontact
{
  /// lambda of a root in a list of all.
  std::complex<double> value_of(const StabilityRoot &root);
  /// Whether a root of F is one that is listed: within 1e-6 of |s|, which the eigenvalues of the states miss by less.
  bool is_at(const std::complex<double> &s, const StabilityRoot &root);
  /// The roots that matter: numbers of those that oscillate and grow, and of the three others that are nearest to that, by
  /// descending divergence rate; where some are exact, of these.
  std::vector<unsigned int> growing_and_nearest(const std::vector<StabilityRoot> &all);

  /// Of a list that is not empty the root nearest to a place.
  const StabilityRoot &nearest_listed(const std::vector<StabilityRoot> &all, const std::complex<double> &s);

  /// A root on its way from case to case: another friction, another place, other dampers. The next case is its F(s) alone,
  ///
  ///     s, x of this case -> start (a prediction) -> Newton on the next F(s) x = 0 -> s, x of the next
  ///
  /// Forces of points that come into contact start from none, those of points that leave it are dropped.
  struct FollowedRoot
  {
    std::complex<double> s;
    /// forces by ContactReceptance::unknowns()
    std::map<unsigned int, std::complex<double>> forces;
    /// of the last step: |F x| / (|F| |x|) [-], Newton iterations
    double residual = 0;
    unsigned int iterations = 0;
  };

  FollowedRoot followed_root(const ContactReceptance &F, const ContactRoot &root);

  /// The root in the next case, with its left vector if asked for. Beyond `reach` it may be found, up to 1e-3 of |s|, where its
  /// forces are those of before (|x_a^H x_b|^2 > 0.5, |x| = 1): two roots that cross, such as those of a wheel's pair of equal
  /// modes, press on the contact alike and unalike.
  /// @param start near which it is sought, such as one step further along a straight line
  /// @throws ConvergenceError if Newton's method finds none, or a neighbour's
  ContactRoot next_root(const FollowedRoot &root, const ContactReceptance &next,
                        const std::complex<double> &start, double reach, bool with_left_vector = false);

  /// How far from its start each root may be found so that it is not taken for a neighbour: half the distance to the nearest of
  /// the others, 2 % of |s| at most.
  std::vector<double> reaches(const std::vector<std::complex<double>> &starts);

  /// y^T F(s) x: by how much another F, of a case nearby, changes the root, -ds to first order.
  /// @pre root.y is known @throws ConvergenceError if other points are in contact
  std::complex<double> change_of_root(const ContactReceptance &root_of, const ContactRoot &root,
                                      const ContactReceptance &other);
} // namespace vibrocontact
