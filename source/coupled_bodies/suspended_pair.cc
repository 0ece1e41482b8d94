#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/reduction/dense_modes.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace vibrocontact
{
  namespace
  {
    /// The modes in the places of the coordinates that they are most alike, their signs as there: modes of the held body 1 by their
    /// share of the strain energy, coordinates of the hub by theirs of the kinetic energy, after the former.
    DenseModes in_places(const DenseModes &modes, const DenseMatrix &stiffness, const DenseMatrix &mass,
                         const unsigned int n_1)
    {
      struct Likeness
      {
        double value;
        unsigned int coordinate, mode;
      };
      std::vector<Likeness> all;
      const unsigned int n = modes.squares.size();
      constexpr double after_held = 1e-6;
      for (unsigned int e = 0; e < n; ++e)
      {
        const auto energy = [&](const DenseMatrix &of, const unsigned int i)
        { return of(i, i) * modes.shapes(i, e) * modes.shapes(i, e); };
        double of_hub = 0;
        for (unsigned int i = n_1; i < n; ++i)
          of_hub += energy(mass, i);
        for (unsigned int i = 0; i < n; ++i)
          if (modes.shapes(i, e) != 0)
            all.push_back({i >= n_1               ? after_held * energy(mass, i) / of_hub
                           : modes.squares[e] > 0 ? energy(stiffness, i) / modes.squares[e]
                                                  : 0.,
                           i, e});
      }
      std::stable_sort(all.begin(), all.end(),
                       [](const Likeness &a, const Likeness &b) { return a.value > b.value; });
      DenseModes result;
      result.squares.resize(n);
      result.shapes.reinit(n, n);
      std::vector<bool> filled(n, false), placed(n, false);
      const auto place = [&](const unsigned int mode, const unsigned int coordinate)
      {
        filled[coordinate] = placed[mode] = true;
        const double sign = modes.shapes(coordinate, mode) < 0 ? -1 : 1;
        for (unsigned int i = 0; i < n; ++i)
          result.shapes(i, coordinate) = sign * modes.shapes(i, mode);
        result.squares[coordinate] = modes.squares[mode];
      };
      for (const Likeness &one : all)
        if (!filled[one.coordinate] && !placed[one.mode])
          place(one.mode, one.coordinate);
      for (unsigned int e = 0, i = 0; e < n; ++e)
        if (!placed[e])
        {
          while (filled[i])
            ++i;
          place(e, i);
        }
      return result;
    }

    void check_mass(const DenseMatrix &coupling, const double mass)
    {
      DenseMatrix rest(3);
      double moved = 0;
      for (unsigned int a = 0; a < 3; ++a)
      {
        for (unsigned int b = 0; b < 3; ++b)
          for (unsigned int k = 0; k < coupling.m(); ++k)
            rest(a, b) -= coupling(k, a) * coupling(k, b);
        moved = std::max(moved, -rest(a, a));
        rest(a, a) += mass;
      }
      if (!(mass > moved) || !factorise_cholesky(rest))
        throw InputError("Rolling/Suspension/Unsprung mass is " + number_text(mass) +
                         " kg, but the modes of body 1 alone move " + number_text(moved) +
                         " kg: give the mass of all that moves with the hub, body 1 included.");
    }

    /// Where the contact's rows see body 1 move: its modes relative to the hub, then the hub's coordinates.
    DenseMatrix rows_of(const ContactPair &held, const unsigned int n_1, const HubCoordinates &hub)
    {
      const PlacedContacts &contacts = held.interface.contacts;
      DenseMatrix rows(3 * held.n_points(), n_1 + hub.n());
      for (unsigned int k = 0; k < n_1; ++k)
        for (unsigned int i = 0; i < rows.m(); ++i)
          rows(i, k) = held.trace(i, k);
      add_block(rows, contacts.translation_of(0), 0, n_1);
      if (hub.n_motions > 3)
        add_block(rows, contacts.rotation_of(0, held.hub_inertia->centre), 0, n_1 + 3);
      return rows;
    }

    /// A matrix over modes of the held body 1 in all coordinates: the copy has the same.
    DenseMatrix with_copy(const DenseMatrix &of_held, const unsigned int n_1, const HubCoordinates &hub)
    {
      const unsigned int first = n_1 + hub.n() - hub.copied.size();
      DenseMatrix result(n_1 + hub.n(), n_1 + hub.n());
      for (unsigned int j = 0; j < n_1; ++j)
        for (unsigned int i = 0; i < n_1; ++i)
          result(i, j) = of_held(i, j);
      for (unsigned int a = 0; a < hub.copied.size(); ++a)
        for (unsigned int b = 0; b < hub.copied.size(); ++b)
          result(first + a, first + b) = of_held(hub.copied[a], hub.copied[b]);
      return result;
    }

    void hang(HystereticLoss &loss, const DenseMatrix &own, const unsigned int n_1,
              const unsigned int n_added)
    {
      const DenseMatrix held = loss.modal;
      const unsigned int n = held.m();
      loss.modal.reinit(n + n_added, n + n_added);
      add_block(loss.modal, own, 0, 0);
      for (unsigned int j = n_1; j < n; ++j)
        for (unsigned int i = n_1; i < n; ++i)
          loss.modal(i + n_added, j + n_added) = held(i, j);
    }

    /// Damping of the modes [1/s] beside its diagonal, as dampers along its eigenvectors, scaled by the diagonal. Those are left out that
    /// do next to nothing beside it.
    void add_damping_between_modes(const DenseMatrix &damping, SuspendedHub &hub)
    {
      constexpr double left_out = 1e-6;
      const unsigned int n = damping.m(), n_before = hub.damping.size();
      DenseMatrix between(n, n), vectors;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          if (i != j && damping(i, i) > 0 && damping(j, j) > 0)
            between(i, j) = damping(i, j) / std::sqrt(damping(i, i) * damping(j, j));
      const std::vector<double> values = symmetric_eigenvalues(between, vectors);
      std::vector<unsigned int> kept;
      for (unsigned int k = 0; k < n; ++k)
        if (std::abs(values[k]) > left_out)
          kept.push_back(k);
      DenseMatrix dampers(n_before + kept.size(), n);
      add_block(dampers, hub.dampers, 0, 0);
      for (unsigned int d = 0; d < kept.size(); ++d)
      {
        hub.damping.push_back(values[kept[d]]);
        for (unsigned int j = 0; j < n; ++j)
          dampers(n_before + d, j) = vectors(j, kept[d]) * std::sqrt(std::max(0., damping(j, j)));
      }
      hub.dampers = dampers;
    }

    /// Names of the modes beyond those of the held body: coordinates of one name are numbered by frequency.
    std::vector<std::string> labels_of(const HubCoordinates &hub, const std::vector<double> &omega)
    {
      std::map<std::string, std::vector<unsigned int>> of_name;
      for (unsigned int k = 0; k < hub.n(); ++k)
        of_name[hub.names[k]].push_back(k);
      std::vector<std::string> result(hub.n());
      for (auto &[name, all] : of_name)
      {
        std::stable_sort(all.begin(), all.end(),
                         [&](const unsigned int a, const unsigned int b) { return omega[a] < omega[b]; });
        for (unsigned int k = 0; k < all.size(); ++k)
          result[all[k]] = all.size() == 1 ? name : name + "(" + std::to_string(k + 1) + ")";
      }
      return result;
    }
  } // namespace

  ContactPair suspended_pair(const ContactPair &held, const HubCoordinates &hub, const DenseVector &preload,
                             HystereticLoss *const loss)
  {
    const unsigned int n_1 = std::count(held.body.begin(), held.body.end(), 1), n_modes = held.n_modes(),
                       n_rows = 3 * held.n_points(), n_hub = hub.n(), n_own = n_1 + n_hub;
    const auto moving = std::make_shared<SuspendedHub>();
    moving->n_added = n_hub;
    moving->n_motions = hub.n_motions;
    moving->mass = hub.mass(2, 2);
    moving->damping = hub.damping;
    moving->coupling.reinit(n_1, n_hub);
    add_block(moving->coupling, hub_coupling(held, hub.n_motions), 0, 0);
    if (hub.n_motions > 3)
      moving->centre = held.hub_inertia->centre;
    check_mass(moving->coupling, moving->mass);
    DenseMatrix K(n_own, n_own), M(n_own, n_own), ratios(n_1, n_1);
    for (unsigned int k = 0; k < n_1; ++k)
    {
      K(k, k) = held.omega[k] * held.omega[k];
      M(k, k) = 1;
      ratios(k, k) = 2 * held.damping_ratio[k] * held.omega[k];
      for (unsigned int y = 0; y < n_hub; ++y)
        M(k, n_1 + y) = M(n_1 + y, k) = moving->coupling(k, y);
    }
    add_block(K, hub.stiffness, n_1, n_1);
    add_block(M, hub.mass, n_1, n_1);
    const DenseModes modes = in_places(dense_modes(K, M, "body 1 on its hub"), K, M, n_1);
    const DenseMatrix &X = modes.shapes;
    moving->shapes = X;
    DenseMatrix stretch(hub.stretch.m(), n_own);
    add_block(stretch, hub.stretch, 0, n_1);
    moving->dampers = product(stretch, X);

    ContactPair pair = held;
    const DenseMatrix rows = rows_of(held, n_1, hub), trace = product(rows, X);
    pair.trace.reinit(n_rows, n_modes + n_hub);
    add_block(pair.trace, trace, 0, 0);
    for (unsigned int k = n_1; k < n_modes; ++k)
      for (unsigned int i = 0; i < n_rows; ++i)
        pair.trace(i, k + n_hub) = held.trace(i, k);
    pair.participation.reinit(n_modes + n_hub, 3);
    const auto insert = [&](auto &list, const auto &value) { list.insert(list.begin() + n_1, n_hub, value); };
    insert(pair.omega, 0.);
    insert(pair.damping_ratio, 0.);
    insert(pair.modal_load, 0.);
    insert(pair.body, 1u);
    for (unsigned int j = 0; j < n_own; ++j)
      pair.omega[j] = std::sqrt(modes.squares[j]);
    const std::vector<std::string> labels =
        labels_of(hub, {pair.omega.begin() + n_1, pair.omega.begin() + n_own});
    pair.labels.insert(pair.labels.begin() + n_1, labels.begin(), labels.end());

    DenseMatrix H = loss ? with_copy(loss->modal, n_1, hub) : DenseMatrix(n_own, n_own);
    add_block(H, hub.loss, n_1, n_1);
    H = projected(H, X);
    const DenseMatrix damping = projected(with_copy(ratios, n_1, hub), X);
    add_damping_between_modes(damping, *moving);
    for (unsigned int j = 0; j < n_own; ++j)
    {
      const double w = pair.omega[j];
      pair.damping_ratio[j] = w > 0 ? damping(j, j) / (2 * w) + (loss ? 0. : H(j, j) / (2 * w * w)) : 0;
      double load = 0;
      for (unsigned int k = 0; k < n_1; ++k)
        load += X(k, j) * held.modal_load[k];
      // what the preload does on the hub's coordinates
      for (unsigned int y = n_1; y < n_own && preload.size() > 0; ++y)
        for (unsigned int i = 0; i < n_rows; ++i)
          load -= X(y, j) * rows(i, y) * preload[i];
      pair.modal_load[j] = load;
    }
    if (loss)
      hang(*loss, H, n_1, n_hub);
    pair.hub = moving;
    return pair;
  }
} // namespace vibrocontact
