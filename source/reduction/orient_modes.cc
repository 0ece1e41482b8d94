#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/locally_owned_values.h>
#include <vibrocontact/reduction/orient_modes.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    // Frequencies closer than this (relative) are one eigenvalue to the solver, which mixes the pair at will.
    constexpr double degenerate = 1e-6;

    template <typename T>
    std::vector<T> gather_on_host(const std::vector<T> &local, MPI_Comm communicator)
    {
      const auto parts = dealii::Utilities::MPI::gather(communicator, local, 0);
      std::vector<T> all;
      for (const auto &part : parts)
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }

    // For every dof the dof of the same direction next to the mirror image in the plane x = 0; on the host.
    class MirrorImages
    {
    public:
      explicit MirrorImages(const SecondOrderSystem &system) : communicator(system.communicator)
      {
        std::vector<double> flat;
        for (const auto &p : system.dof_position)
          flat.insert(flat.end(), {p[0], p[1], p[2]});
        flat = gather_on_host(flat, communicator);
        direction = gather_on_host(system.dof_direction, communicator);
        Vector diagonal(system.locally_owned, communicator);
        MatGetDiagonal(system.mass, diagonal);
        mass = gather_on_host(locally_owned_values(diagonal), communicator);
        if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
          return;
        using Entry = std::pair<dealii::Point<3>, unsigned int>;
        std::array<std::vector<Entry>, 7> entries;
        for (unsigned int i = 0; i < direction.size(); ++i)
          if (mass[i] > 0)
            entries[direction[i]].emplace_back(
                dealii::Point<3>(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]), i);
        image.resize(direction.size(), 0);
        for (unsigned int d = 0; d < entries.size(); ++d)
        {
          const auto tree = dealii::pack_rtree(entries[d]);
          std::vector<Entry> nearest;
          for (const auto &[place, i] : entries[d])
          {
            nearest.clear();
            tree.query(boost::geometry::index::nearest(dealii::Point<3>(-place[0], place[1], place[2]), 1),
                       std::back_inserter(nearest));
            image[i] = nearest[0].second;
          }
        }
      }

      // Angle by which the pair (a, b) is turned so that a becomes symmetric and b antisymmetric; the same on
      // all ranks.
      double angle(const Vector &a, const Vector &b) const
      {
        const auto u = gather_on_host(locally_owned_values(a), communicator),
                   v = gather_on_host(locally_owned_values(b), communicator);
        double saa = 0, sbb = 0, sab = 0;
        for (unsigned int i = 0; i < image.size(); ++i)
          if (mass[i] > 0)
          {
            // u_x, rotations about y and z and warping change their sign in the mirror
            const bool turns = direction[i] == 0 || direction[i] >= 4;
            const double w = turns ? -mass[i] : mass[i];
            saa += w * u[i] * u[image[i]];
            sbb += w * v[i] * v[image[i]];
            sab += w * (u[i] * v[image[i]] + v[i] * u[image[i]]) / 2;
          }
        return dealii::Utilities::MPI::broadcast(communicator, std::atan2(2 * sab, saa - sbb) / 2);
      }

    private:
      MPI_Comm communicator;
      std::vector<unsigned char> direction;
      std::vector<double> mass;
      std::vector<unsigned int> image;
    };

    // A smooth field without symmetry; the sign of a shape is that of its projection on the first field that
    // sees it.
    double probe(const unsigned int field, const dealii::Point<3> &p, const unsigned char direction,
                 const double size)
    {
      const double a = 1.7 + 2.3 * field;
      return std::sin(a * (1.31 * p[0] + 0.83 * p[1] + 1.97 * p[2]) / size + 0.7 + 1.1 * direction + field) +
             std::cos(a * (2.17 * p[0] - 1.49 * p[1] + 0.57 * p[2]) / size + 0.4 - 1.9 * direction);
    }
  } // namespace

  void orient_modes(const SecondOrderSystem &system, Modes &modes)
  {
    if (system.dof_position.size() != system.locally_owned.n_elements() || modes.shapes.empty())
    {
      AssertThrow(modes.shapes.empty(),
                  dealii::ExcMessage("Body '" + system.body + "' does not say where its dofs are."));
      return;
    }
    std::unique_ptr<MirrorImages> images;
    for (unsigned int i = modes.n_rigid_modes; i + 1 < modes.shapes.size(); ++i)
      if (modes.omega[i + 1] < modes.omega[i] * (1 + degenerate))
      {
        if (!images)
          images = std::make_unique<MirrorImages>(system);
        Vector &a = modes.shapes[i], &b = modes.shapes[i + 1];
        const double angle = images->angle(a, b), c = std::cos(angle), s = std::sin(angle);
        Vector turned(a);
        turned.sadd(c, s, b);
        b.sadd(c, -s, a);
        a = turned;
        ++i;
      }

    double size = 0;
    for (const auto &p : system.dof_position)
      size = std::max(size, p.norm());
    size = dealii::Utilities::MPI::max(size, system.communicator);
    Vector diagonal(system.locally_owned, system.communicator);
    MatGetDiagonal(system.mass, diagonal);
    const auto mass = locally_owned_values(diagonal);
    for (auto &shape : modes.shapes)
    {
      const auto u = locally_owned_values(shape);
      for (unsigned int field = 0; field < 20; ++field)
      {
        std::array<double, 3> sums{}; // projection, |probe|^2, |u|^2
        for (unsigned int i = 0; i < u.size(); ++i)
        {
          const double g = probe(field, system.dof_position[i], system.dof_direction[i], size);
          sums[0] += mass[i] * g * u[i];
          sums[1] += mass[i] * g * g;
          sums[2] += mass[i] * u[i] * u[i];
        }
        MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_DOUBLE, MPI_SUM, system.communicator);
        if (std::abs(sums[0]) > 1e-4 * std::sqrt(sums[1] * sums[2]))
        {
          if (sums[0] < 0)
            shape *= -1;
          break;
        }
      }
    }
  }
} // namespace vibrocontact
