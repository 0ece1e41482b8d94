#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/all_roots.h>
#include <vibrocontact/coupled_bodies/exact_roots.h>
#include <vibrocontact/coupled_bodies/inertial_contact.h>

#include <string>

namespace vibrocontact
{
  // Closed points that nothing yields move with the modes, whose mass is theirs.
  std::vector<StabilityRoot> all_roots(const ContactPair &pair, const CreepScheme &scheme,
                                       const RollingEquilibrium &about, const LinearisationOptions &options,
                                       const HystereticLoss *const loss)
  {
    const DenseMatrix W = compliance_of_contact(pair, about);
    unsigned int n_closed = 0, n_rigid = 0;
    for (unsigned int i = 0; i < pair.n_points(); ++i)
    {
      n_closed += about.contact.R[i] > 0;
      n_rigid += about.contact.R[i] > 0 && W(i, i) == 0;
    }
    if (n_rigid == 0 && loss)
    {
      std::vector<StabilityRoot> roots = hysteretic_roots(pair, *loss, scheme, about, options);
      if (!loss->exact.empty())
        make_exact(roots, pair, scheme, about, *loss);
      return roots;
    }
    if (n_rigid == 0)
      return stability_roots(pair, linearised_contact(pair, scheme, about, options));
    if (loss)
      throw InputError("A closed contact point has mass and nothing that yields, which Stability/Loss "
                       "hysteretic does not take: set it to viscous, or give Contact/Normal law one that "
                       "yields.");
    const std::string other = pair.hub             ? "the hub moves: set Rolling/Hub to held"
                              : pair.n_poles() > 0 ? "a body is known by poles: take one of modes"
                              : n_rigid < n_closed ? "other closed points yield: make all of them alike"
                                                   : "";
    if (!other.empty())
      throw InputError("A closed contact point has mass and nothing that yields, but " + other +
                       ", or give Contact/Normal law one that yields.");
    return inertial_roots(inertial_pair(pair), scheme, about, options);
  }
} // namespace vibrocontact
