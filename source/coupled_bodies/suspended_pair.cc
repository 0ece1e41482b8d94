#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// modes with less of it do not move the hub
    constexpr double least_participation = 1e-7;

    /// The new modes in the places of those they are most alike.
    void put_in_places(const std::vector<unsigned int> &places, const DenseMatrix &mass,
                       const std::vector<DenseVector> &vectors, const std::vector<double> &squares,
                       DenseMatrix &shapes, std::vector<double> &omega)
    {
      struct Likeness
      {
        double value;
        unsigned int coordinate, vector;
      };
      std::vector<Likeness> all;
      const unsigned int n = vectors.size();
      for (unsigned int e = 0; e < n; ++e)
        for (unsigned int i = 0; i < n; ++i)
          all.push_back({vectors[e][i] * vectors[e][i] * mass(i, i), i, e});
      std::stable_sort(all.begin(), all.end(),
                       [](const Likeness &a, const Likeness &b) { return a.value > b.value; });
      std::vector<bool> filled(n, false), placed(n, false);
      for (const Likeness &one : all)
      {
        if (filled[one.coordinate] || placed[one.vector])
          continue;
        filled[one.coordinate] = placed[one.vector] = true;
        const unsigned int column = places[one.coordinate];
        const double sign = vectors[one.vector][one.coordinate] < 0 ? -1 : 1;
        for (unsigned int i = 0; i < n; ++i)
          shapes(places[i], column) = sign * vectors[one.vector][i];
        omega[column] = std::sqrt(std::max(0., squares[one.vector]));
      }
    }

    void check_mass(const DenseMatrix &participation, const double mass)
    {
      DenseMatrix rest(3);
      double moved = 0;
      for (unsigned int a = 0; a < 3; ++a)
      {
        for (unsigned int b = 0; b < 3; ++b)
          for (unsigned int k = 0; k < participation.m(); ++k)
            rest(a, b) -= participation(k, a) * participation(k, b);
        moved = std::max(moved, -rest(a, a));
        rest(a, a) += mass;
      }
      if (!(mass > moved) || !factorise_cholesky(rest))
        throw InputError("Rolling/Suspension/Unsprung mass is " + number_text(mass) +
                         " kg, but the modes of body 1 alone move " + number_text(moved) +
                         " kg: give the mass of all that moves with the hub, body 1 included.");
    }
  } // namespace

  ContactPair suspended_pair(const ContactPair &held, const SuspensionParameters &suspension,
                             const std::vector<double> &reaction)
  {
    const unsigned int n_1 = std::count(held.body.begin(), held.body.end(), 1), n_modes = held.n_modes(),
                       n = held.n_points();
    const auto hub = std::make_shared<SuspendedHub>();
    hub->mass = suspension.mass;
    std::copy_n(suspension.damping, 3, hub->damping);
    hub->participation.reinit(n_1, 3);
    double largest = 0;
    for (unsigned int k = 0; k < n_1 && held.participation.m() > 0; ++k)
      for (unsigned int d = 0; d < 3; ++d)
      {
        hub->participation(k, d) = held.participation(k, d);
        largest = std::max(largest, std::abs(held.participation(k, d)));
      }
    std::vector<unsigned int> places;
    for (unsigned int k = 0; k < n_1; ++k)
    {
      double *const row[] = {&hub->participation(k, 0), &hub->participation(k, 1), &hub->participation(k, 2)};
      if (std::any_of(row, row + 3,
                      [&](const double *p) { return std::abs(*p) > least_participation * largest; }))
        places.push_back(k);
      else
        for (double *const p : row)
          *p = 0;
    }
    check_mass(hub->participation, suspension.mass);
    const unsigned int n_coupled = places.size(), size = n_coupled + 3;
    DenseMatrix K(size), M(size);
    for (unsigned int i = 0; i < n_coupled; ++i)
    {
      K(i, i) = held.omega[places[i]] * held.omega[places[i]];
      M(i, i) = 1;
      for (unsigned int d = 0; d < 3; ++d)
        M(i, n_coupled + d) = M(n_coupled + d, i) = hub->participation(places[i], d);
    }
    for (unsigned int d = 0; d < 3; ++d)
    {
      places.push_back(n_1 + d);
      K(n_coupled + d, n_coupled + d) = suspension.stiffness[d];
      M(n_coupled + d, n_coupled + d) = suspension.mass;
    }
    const DenseMatrix mass = M;
    std::vector<DenseVector> vectors(size, DenseVector(size));
    try
    {
      K.compute_generalized_eigenvalues_symmetric(M, vectors);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw ConvergenceError("LAPACK found no modes of body 1 on its suspension.");
    }
    std::vector<double> squares(size), omega(held.omega.begin(), held.omega.begin() + n_1);
    for (unsigned int e = 0; e < size; ++e)
      squares[e] = K.eigenvalue(e).real();
    omega.resize(n_1 + 3);
    hub->shapes.reinit(n_1 + 3);
    for (unsigned int k = 0; k < n_1; ++k)
      hub->shapes(k, k) = 1;
    put_in_places(places, mass, vectors, squares, hub->shapes, omega);

    ContactPair pair = held;
    const DenseMatrix &X = hub->shapes;
    DenseMatrix coordinates(3 * n, n_1 + 3);
    const DenseMatrix translation = held.interface.contacts.translation_of(0);
    for (unsigned int i = 0; i < 3 * n; ++i)
    {
      for (unsigned int k = 0; k < n_1; ++k)
        coordinates(i, k) = held.trace(i, k);
      for (unsigned int d = 0; d < 3; ++d)
        coordinates(i, n_1 + d) = translation(i, d);
    }
    pair.trace.reinit(3 * n, n_modes + 3);
    add_block(pair.trace, product(coordinates, X), 0, 0);
    for (unsigned int k = n_1; k < n_modes; ++k)
      for (unsigned int i = 0; i < 3 * n; ++i)
        pair.trace(i, k + 3) = held.trace(i, k);
    pair.participation.reinit(n_modes + 3, 3);
    const auto insert = [&](auto &list, const auto &value) { list.insert(list.begin() + n_1, 3, value); };
    insert(pair.omega, 0.);
    insert(pair.damping_ratio, 0.);
    insert(pair.modal_load, 0.);
    insert(pair.body, 1u);
    pair.labels.insert(pair.labels.begin() + n_1, {"hub:x", "hub:y", "hub:z"});
    for (unsigned int j = 0; j < n_1 + 3; ++j)
    {
      double damping = 0, load = 0;
      for (unsigned int i = 0; i < n_1; ++i)
      {
        damping += X(i, j) * X(i, j) * 2 * held.damping_ratio[i] * held.omega[i];
        load += X(i, j) * held.modal_load[i];
      }
      for (unsigned int d = 0; d < 3; ++d)
        load -= hub->motion(d, j) * reaction[d];
      pair.omega[j] = omega[j];
      pair.damping_ratio[j] = omega[j] > 0 ? damping / (2 * omega[j]) : 0;
      pair.modal_load[j] = load;
    }
    pair.hub = hub;
    return pair;
  }
} // namespace vibrocontact
