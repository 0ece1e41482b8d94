#include <vibrocontact/base/collective.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/revolved_reduction.h>
#include <vibrocontact/reduction/wave_mode.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /// so many n in a row without modes end the search, from two waves on: there frequencies grow with n
    constexpr unsigned int empty_in_a_row = 2;
  } // namespace

  Vector centrifugal_displacement(const RevolvedSection &section)
  {
    const auto still = section.system(0);
    Flexibility flexibility(*still);
    const Vector load = section.centrifugal_load();
    Vector result(load);
    flexibility.vmult(result, load);
    return result;
  }

  void RevolvedReduction::add_rotation(const RevolvedRotation &rotation, const Modes &modes,
                                       WaveMode &mode) const
  {
    const Vector &shape = modes.shapes[mode.number];
    const auto &components = section->components();
    // of n = 0 both families are in a shape: the odd one is what moves around the axle
    const auto family = [&](const Vector &whole, const bool odd)
    {
      Vector part(whole);
      for (unsigned int i = 0; i < components.size() && mode.n == 0; ++i)
        if ((components[i] == RevolvedSection::circumferential) != odd)
          part(i) = 0;
      part.compress(dealii::VectorOperation::insert);
      return part;
    };
    const Vector even = family(shape, false), odd = family(shape, true);
    Vector product(shape);
    for (const Vector &other : modes.shapes)
    {
      rotation.coriolis.vmult(product, family(other, true));
      double coupling = even * product;
      if (mode.n == 0)
      {
        rotation.coriolis.vmult(product, family(other, false));
        coupling -= odd * product;
      }
      mode.coriolis.push_back(coupling);
      rotation.geometric.vmult(product, other);
      double of_square = shape * product;
      rotation.centripetal.vmult(product, other);
      of_square -= shape * product;
      mode.of_square.push_back(of_square);
    }
  }

  std::vector<WaveMode> RevolvedReduction::modes_of(const unsigned int n, const ModeParameters &parameters,
                                                    const WheelFrame &frame,
                                                    const Vector *const stretched) const
  {
    const auto system = section->system(n);
    Flexibility flexibility(*system);
    const Modes modes = compute_modes(*system, flexibility, parameters);
    const auto rotation = stretched ? section->rotation(n, *stretched) : nullptr;
    const std::vector<std::vector<double>> energies = section->energies_of_parts(n, modes.shapes);
    const std::vector<TraceRow> boundary = section->boundary(n).rows;
    const auto &places = section->positions();
    const auto &components = section->components();
    const unsigned int n_dofs = places.size();

    Vector diagonal(system->locally_owned, MPI_COMM_SELF);
    MatGetDiagonal(system->mass, diagonal);
    using Rigid = RevolvedSection::RigidMotion;
    std::vector<Vector> momentum;
    for (const Rigid motion :
         {n == 0 ? Rigid::along_axle : Rigid::across_axle, n == 0 ? Rigid::about_axle : Rigid::tilt})
      if (n < 2)
        momentum.push_back(section->momentum(n, section->rigid_motion(motion)));
    WheelRaster raster{1e300, 0, 1e300, -1e300, frame.rim_radius};
    for (const auto &place : places)
    {
      raster.r_min = std::min(raster.r_min, place[1]);
      raster.r_max = std::max(raster.r_max, place[1]);
      if (!raster.is_rim(place[1]))
        continue;
      raster.y_min = std::min(raster.y_min, place[0]);
      raster.y_max = std::max(raster.y_max, place[0]);
    }
    raster.check(name);

    std::vector<WaveMode> result;
    for (unsigned int k = 0; k < modes.omega.size(); ++k)
    {
      const Vector &shape = modes.shapes[k];
      WaveMode mode;
      mode.n = n;
      mode.number = k;
      if (rotation)
        add_rotation(*rotation, modes, mode);
      mode.omega = modes.omega[k];
      const auto n_modes = modes.omega.size();
      for (const std::vector<double> &of_part : energies)
        mode.energies.insert(mode.energies.end(), of_part.begin() + k * n_modes,
                             of_part.begin() + (k + 1) * n_modes);
      mode.orthonormality_error = modes.orthonormality_error;
      mode.residual = modes.residual;
      mode.tread = values_of(tread_rows, shape);
      mode.boundary = values_of(boundary, shape);
      for (const bool odd : {false, true})
        if (const auto weight = section->weight(n, odd))
          mode.load[odd] = shape * *weight;
      if (n < 2)
      {
        // x = r sin + t cos, z = -r cos + t sin
        const double along = shape * momentum[0], turning = shape * momentum[1];
        mode.even[n == 0 ? 1 : 2] = n == 0 ? along : -along;
        mode.even[n == 0 ? 4 : 3] = turning;
        if (n == 1)
        {
          mode.odd[0] = along;
          mode.odd[5] = turning;
        }
      }

      std::array<std::array<double, 2>, 3 * WheelRaster::n_rim> rim{};
      std::array<std::array<double, 2>, WheelRaster::n_rings> web{};
      for (unsigned int i = 0; i < n_dofs; ++i)
      {
        const double radius = places[i][1], m = diagonal(i), u = shape(i);
        const unsigned int c = components[i];
        if (raster.is_rim(radius))
        {
          auto &cell = rim[c * WheelRaster::n_rim + raster.rim_cell(radius, places[i][0])];
          cell[0] += m;
          cell[1] += m * u;
        }
        if (c == RevolvedSection::axial)
        {
          auto &ring = web[raster.ring(radius)];
          ring[0] += m;
          ring[1] += m * u;
        }
      }
      WheelMotion motion;
      motion.nodal_diameters = n;
      for (unsigned int j = 0; j < rim.size(); ++j)
        if (rim[j][0] > 0)
        {
          motion.rim_energy[j / WheelRaster::n_rim] += rim[j][1] * rim[j][1] / rim[j][0];
          motion.rim_mass += rim[j][0] / 3;
        }
      for (const auto &ring : web)
        if (ring[0] > 0)
          motion.axial.push_back(ring[1] / ring[0]);
      const WheelLabel label = wheel_label(motion);
      mode.family = label.family;
      mode.nodal_circles = label.nodal_circles;
      result.push_back(std::move(mode));
    }
    return result;
  }

  std::vector<WaveMode> RevolvedReduction::all_modes(const ModeParameters &parameters,
                                                     const WheelFrame &frame, const bool rotates) const
  {
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator),
                       rank = MPI::this_mpi_process(communicator);
    std::vector<WaveMode> modes;
    Progress progress(name + ": modes by harmonics", 24);
    const auto counts = [](const WaveMode &mode) { return mode.n == 0 ? 1u : 2u; };
    // of the count that is asked for, the highest so far
    const auto is_wanted = [&](const WaveMode &mode)
    {
      if (parameters.upper_frequency > 0)
        return true;
      unsigned int below = 0;
      for (const WaveMode &other : modes)
        below += other.omega < mode.omega ? counts(other) : 0;
      return below < parameters.count;
    };
    std::optional<Vector> stretched;
    if (rotates)
      on_all_ranks(
          [&]
          {
            const LoneWave alone;
            stretched = centrifugal_displacement(*section);
          },
          communicator);
    for (unsigned int n = 0, empty = 0; empty < empty_in_a_row;)
    {
      std::vector<WaveMode> own;
      on_all_ranks(
          [&]
          {
            const LoneWave alone;
            own = modes_of(n + rank, parameters, frame, stretched ? &*stretched : nullptr);
          },
          communicator);
      progress.advance(n_ranks);
      for (std::vector<WaveMode> &found : MPI::all_gather(communicator, own))
      {
        const unsigned int before = modes.size();
        modes.insert(modes.end(), found.begin(), found.end());
        const bool any = std::any_of(modes.begin() + before, modes.end(), is_wanted);
        empty = any || n < 2 ? 0 : empty + 1;
        ++n;
      }
    }
    std::stable_sort(modes.begin(), modes.end(),
                     [](const WaveMode &a, const WaveMode &b) { return a.omega < b.omega; });
    modes.resize(std::count_if(modes.begin(), modes.end(), is_wanted));
    return modes;
  }
} // namespace vibrocontact
