#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/inertial_contact.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/null_space.h>
#include <vibrocontact/reduction/attachment_inertia.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    DenseMatrix independent_null_space(const DenseMatrix &columns, const unsigned int N)
    {
      std::optional<DenseMatrix> basis = null_space(columns, N);
      if (!basis)
        throw ConvergenceError("The gaps of the contact points depend on each other: the bodies have fewer "
                               "dofs than contact points; keep more modes.");
      return *basis;
    }

    // with a given force the gaps under the hub change by `hub` alike and hub . dN is zero: what is left of the columns
    // when that of the first such point takes it
    DenseMatrix without_hub(const DenseMatrix &columns, const std::vector<double> &hub)
    {
      const auto under = std::find_if(hub.begin(), hub.end(), [](const double share) { return share != 0; });
      if (under == hub.end())
        return columns;
      const unsigned int first = under - hub.begin();
      DenseMatrix result(columns.m(), columns.n() - 1);
      for (unsigned int j = 0, column = 0; j < columns.n(); ++j)
        if (j != first)
        {
          for (unsigned int i = 0; i < columns.m(); ++i)
            result(i, column) = columns(i, j) - hub[j] / hub[first] * columns(i, first);
          ++column;
        }
      return result;
    }

    // matrix += forces diag(factor) slips
    void add_friction(DenseMatrix &matrix, const DenseMatrix &forces, const std::vector<double> &factor,
                      DenseMatrix slips)
    {
      if (factor.empty())
        return;
      for (unsigned int j = 0; j < slips.n(); ++j)
        for (unsigned int k = 0; k < slips.m(); ++k)
          slips(k, j) *= factor[k];
      matrix.add(1., product(forces, slips));
    }
  } // namespace

  InertialPair inertial_pair(const ContactPair &pair)
  {
    const unsigned int m = pair.n_modes();
    InertialPair result;
    result.contacts = pair.interface.contacts;
    result.mass.reinit(m);
    result.damping.reinit(m);
    result.stiffness.reinit(m);
    // what follows residual attachment modes bears the name of a free one
    std::vector<unsigned int> free;
    for (unsigned int k = 0; k < m; ++k)
      if (pair.labels[k].find(residual_label) == std::string::npos)
        free.push_back(k);
    result.to_modes.reinit(free.size(), m);
    for (unsigned int k = 0; k < free.size(); ++k)
    {
      result.to_modes(k, free[k]) = 1;
      result.omega.push_back(pair.omega[free[k]]);
      result.labels.push_back(pair.labels[free[k]]);
    }
    for (unsigned int k = 0; k < m; ++k)
    {
      result.mass(k, k) = 1;
      result.damping(k, k) = 2 * pair.damping_ratio[k] * pair.omega[k];
      result.stiffness(k, k) = pair.omega[k] * pair.omega[k];
    }
    result.trace = pair.trace;
    return result;
  }

  ContactCoupling contact_coupling(const DenseMatrix &trace, const PlacedContacts &contacts,
                                   const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                   const LinearisationOptions &options)
  {
    const unsigned int n = contacts.n_points(), N = trace.n();
    SlidingFrame frame = sliding_frame(equilibrium);
    if (frame.n_stick > 0)
      throw InputError("The equilibrium is not in full sliding (" + std::to_string(frame.n_stick) + " of " +
                       std::to_string(frame.points.size()) +
                       " points stick), which only Stability/Model = reduced takes: raise the creepage.");
    if (!options.lateral_damping)
      frame.keep_sticking_only();

    ContactCoupling coupling;
    coupling.damping.reinit(N);
    coupling.stiffness.reinit(N);
    DenseMatrix convective(3 * n, N);
    if (options.convection && equilibrium.speed > 0)
    {
      convective = trace;
      convert_to_slip_rows(contacts, scheme, equilibrium.speed, convective);
    }
    std::vector<double> across;
    for (const double mobility : frame.mobility)
      across.push_back(1 / mobility);
    for (const auto &[directions, factor] :
         {std::make_pair(&frame.across, &across), {&frame.along, &frame.falling}})
    {
      const DenseMatrix slips = rows_along(trace, *directions, n), forces = transposed(slips);
      add_friction(coupling.damping, forces, *factor, slips);
      if (equilibrium.speed > 0)
        add_friction(coupling.stiffness, forces, *factor, rows_along(convective, *directions, n));
    }

    // a closed point that the law yields at has a spring, any other keeps its gap
    std::vector<unsigned int> springs, closed;
    std::vector<double> stiffness;
    for (unsigned int k = 0; k < frame.points.size(); ++k)
    {
      const double compliance =
          equilibrium.normal_compliance.empty() ? 0. : equilibrium.normal_compliance[frame.points[k]];
      (compliance > 0 ? springs : closed).push_back(k);
      if (compliance > 0)
        stiffness.push_back(1 / compliance);
    }
    if (!springs.empty() && equilibrium.force_given)
      throw InputError(
          "Stability/Model gives the contact points mass and Contact/Normal law yields, which needs "
          "a hub that is held: set Rolling/Hub to held, or Model to reduced.");
    DenseMatrix all_forces(N, frame.points.size());
    if (!frame.points.empty())
      trace.Tmmult(all_forces, frame.normal);
    const auto columns = [&](const std::vector<unsigned int> &points, const bool of_forces)
    {
      DenseMatrix result(N, points.size());
      for (unsigned int k = 0; k < points.size(); ++k)
        for (unsigned int j = 0; j < N; ++j)
          result(j, k) = of_forces ? all_forces(j, points[k]) : trace(frame.points[points[k]], j);
      return result;
    };
    if (!springs.empty())
      add_friction(coupling.stiffness, columns(springs, true), stiffness,
                   transposed(columns(springs, false)));
    coupling.gaps = columns(closed, false);
    coupling.forces = columns(closed, true);
    if (equilibrium.force_given && !closed.empty())
    {
      const DenseMatrix translation = contacts.translation_of(0);
      std::vector<double> hub;
      for (const unsigned int k : closed)
        hub.push_back(translation(frame.points[k], 2));
      coupling.gaps = without_hub(coupling.gaps, hub);
      coupling.forces = without_hub(coupling.forces, hub);
    }
    return coupling;
  }

  std::vector<StabilityRoot> inertial_roots(const InertialPair &pair, const CreepScheme &scheme,
                                            const RollingEquilibrium &equilibrium,
                                            const LinearisationOptions &options)
  {
    const ContactCoupling coupling =
        contact_coupling(pair.trace, pair.contacts, scheme, equilibrium, options);
    DenseMatrix damping = pair.damping, stiffness = pair.stiffness;
    damping.add(1., coupling.damping);
    stiffness.add(1., coupling.stiffness);
    // u = Z z, tested with Y
    const DenseMatrix Z = independent_null_space(coupling.gaps, pair.mass.m()),
                      Y = independent_null_space(coupling.forces, pair.mass.m());
    const unsigned int size = Z.n();
    const auto projected = [&](const DenseMatrix &matrix)
    {
      DenseMatrix result(size);
      Y.Tmmult(result, product(matrix, Z));
      return result;
    };
    DenseMatrix M = projected(pair.mass), K = projected(stiffness), C = projected(damping);
    M.compute_lu_factorization();
    M.solve(K);
    M.solve(C);
    DenseMatrix A(2 * size);
    for (unsigned int j = 0; j < size; ++j)
    {
      A(j, size + j) = 1;
      for (unsigned int i = 0; i < size; ++i)
      {
        A(size + i, j) = -K(i, j);
        A(size + i, size + j) = -C(i, j);
      }
    }
    const Eigenvalues lambda = eigenvalues(std::move(A));

    const DenseMatrix to_modes = product(pair.to_modes, Z);
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < lambda.values.size(); ++k)
    {
      if (!is_listed(lambda.values[k]))
        continue;
      std::vector<std::complex<double>> amplitudes(to_modes.m());
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < to_modes.m(); ++i)
          amplitudes[i] += to_modes(i, j) * lambda.component(j, k);
      roots.push_back(named_root(lambda.values[k], std::move(amplitudes), pair.omega, pair.labels));
    }
    sort_roots(roots);
    return roots;
  }
} // namespace vibrocontact
