#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/contact/short_waves.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/revolved_reduction.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /// angles of the surface's points for each wave of the shortest mode; least number of them
    constexpr unsigned int angles_per_wave = 8, fewest_angles = 64;
    /// so many n in a row without modes end the search, from two waves on: there frequencies grow with n
    constexpr unsigned int empty_in_a_row = 2;

    std::vector<double> values_of(const std::vector<TraceRow> &rows, const Vector &shape)
    {
      ContactTrace trace;
      trace.rows = rows;
      return contact_trace(trace, shape);
    }

    /// One n is reduced by one rank alone, and silently.
    struct Alone
    {
      SingleRank rank;
      Log::Aside silence{"", false};
    };
  } // namespace

  /// A mode of n waves; replicated.
  struct RevolvedReduction::WaveMode
  {
    unsigned int n = 0;
    double omega = 0, damping_ratio = 0, orthonormality_error = 0, residual = 0;
    std::string family;
    unsigned int nodal_circles = 0;
    /// at the rows of the contact and at the section's boundary
    std::vector<double> tread, boundary;
    /// phi^T F and phi^T M e of unit translations along x, y, z of the family even, of odd
    std::vector<double> load = {0, 0}, even = {0, 0, 0}, odd = {0, 0, 0};
    /// its number among all modes of n; products with these of 2 Omega's matrix, even with odd (of n = 0 with both), and of
    /// that of Omega^2; none without rotation
    unsigned int number = 0;
    std::vector<double> coriolis, of_square;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &n &omega &damping_ratio &orthonormality_error &residual &family &nodal_circles &tread &boundary
          &load &even &odd &number &coriolis &of_square;
    }
  };

  RevolvedReduction::RevolvedReduction(std::unique_ptr<const RevolvedSection> section,
                                       const std::string &name, const double radius,
                                       const double lateral_position, const std::optional<Contact> &contact,
                                       const MPI_Comm communicator)
      : section(std::move(section)), name(name), radius(radius), lateral_position(lateral_position),
        contact(contact), communicator(communicator)
  {
    if (!contact)
      return;
    const ContactGrid &grid = contact->grid;
    for (const auto component :
         {RevolvedSection::axial, RevolvedSection::radial, RevolvedSection::circumferential})
      for (unsigned int j = 0; j < grid.n_y; ++j)
      {
        const double y = lateral_position + grid.y_first + j * grid.spacing_y;
        tread_rows.push_back(this->section->mean_over(contact->tread, y - grid.spacing_y / 2,
                                                      y + grid.spacing_y / 2, component));
      }
  }

  DenseMatrix RevolvedReduction::around(const unsigned int n, const bool odd) const
  {
    const ContactGrid &grid = contact->grid;
    const unsigned int n_points = grid.n_points(), n_y = grid.n_y;
    DenseMatrix result(3 * n_points, 3 * n_y);
    for (unsigned int i = 0; i < n_points; ++i)
    {
      const double theta = std::asin(grid.x(i) / radius),
                   half = (std::asin((grid.x(i) + grid.spacing_x / 2) / radius) -
                           std::asin((grid.x(i) - grid.spacing_x / 2) / radius)) /
                          2;
      // means over the cell of cos(m theta), sin(m theta)
      const auto cosine = [&](const int m)
      { return m == 0 ? 1. : std::cos(m * theta) * std::sin(m * half) / (m * half); };
      const auto sine = [&](const int m)
      { return m == 0 ? 0. : std::sin(m * theta) * std::sin(m * half) / (m * half); };
      const int m = n;
      const double cos_cos = (cosine(m + 1) + cosine(m - 1)) / 2,
                   sin_sin = (cosine(m - 1) - cosine(m + 1)) / 2,
                   // the first of cos(n theta), sin(n theta), the second of cos(theta), sin(theta)
          cos_sin = (sine(m + 1) - sine(m - 1)) / 2, sin_cos = (sine(m + 1) + sine(m - 1)) / 2;
      const unsigned int j = i / grid.n_x, W = j, U = n_y + j, V = 2 * n_y + j;
      const unsigned int z = contact_row(n_points, 0, i), x = contact_row(n_points, 1, i),
                         y = contact_row(n_points, 2, i);
      // e_r = (sin, -cos), e_t = (cos, sin) in x and z
      if (!odd || n == 0)
      {
        result(z, U) += -cos_cos;
        result(x, U) += cos_sin;
        result(y, W) += cosine(m);
        result(z, V) += sin_sin;
        result(x, V) += sin_cos;
      }
      if (odd || n == 0)
      {
        result(z, U) += -sin_cos;
        result(x, U) += sin_sin;
        result(y, W) += sine(m);
        result(z, V) += -cos_sin;
        result(x, V) += -cos_cos;
      }
    }
    return result;
  }

  void RevolvedReduction::turn_with_tread(DenseMatrix &compliance) const
  {
    const unsigned int n = contact->grid.n_points();
    const auto turn = [](double &normal, double &along, const double sine, const double cosine)
    {
      const double z = cosine * normal + sine * along;
      along = cosine * along - sine * normal;
      normal = z;
    };
    for (unsigned int i = 0; i < n; ++i)
    {
      const double sine = contact->grid.x(i) / radius, cosine = std::sqrt(1 - sine * sine);
      const unsigned int z = contact_row(n, 0, i), x = contact_row(n, 1, i);
      for (unsigned int k = 0; k < 3 * n; ++k)
        turn(compliance(z, k), compliance(x, k), sine, cosine);
      for (unsigned int k = 0; k < 3 * n; ++k)
        turn(compliance(k, z), compliance(k, x), sine, cosine);
    }
  }

  StaticReduction RevolvedReduction::statics() const
  {
    AssertThrow(contact, dealii::ExcInternalError());
    dealii::Timer timer;
    const ContactGrid &grid = contact->grid;
    const unsigned int n_points = grid.n_points(), N = contact->n_harmonics,
                       n_ranks = MPI::n_mpi_processes(communicator);
    StaticReduction result;
    result.name = name;
    result.grid = grid;
    result.n_dofs = section->n_dofs();
    result.load_response.assign(3 * n_points, 0.);
    result.compliance.reinit(3 * n_points, 3 * n_points);
    on_all_ranks(
        [&]
        {
          Progress progress(name + ": contact compliance by harmonics", N / n_ranks + 1.);
          for (unsigned int n = MPI::this_mpi_process(communicator); n <= N; n += n_ranks)
          {
            const Alone alone;
            const auto system = section->system(n);
            system->trace.rows = tread_rows;
            Flexibility flexibility(*system);
            const DenseMatrix between = flexibility.contact_compliance();
            for (const bool odd : {false, true})
            {
              const DenseMatrix spread = around(n, odd);
              if (!(odd && n == 0))
              {
                DenseMatrix half = product(spread, between);
                half.mTmult(result.compliance, spread, true);
              }
              if (const auto weight = section->weight(n, odd))
              {
                Vector u(*weight);
                flexibility.vmult(u, *weight);
                const std::vector<double> answer = values_of(tread_rows, u);
                DenseVector at_points(3 * n_points);
                spread.vmult(at_points, DenseVector(answer.begin(), answer.end()));
                for (unsigned int i = 0; i < 3 * n_points; ++i)
                  result.load_response[i] += at_points[i];
              }
            }
            progress.advance();
          }
        },
        communicator);
    MPI::sum(result.load_response, communicator, result.load_response);
    std::vector<double> entries(&result.compliance(0, 0),
                                &result.compliance(0, 0) + std::size_t(9) * n_points * n_points);
    MPI::sum(entries, communicator, entries);
    std::copy(entries.begin(), entries.end(), &result.compliance(0, 0));
    const HalfSpaceMaterial rigid_body{std::numeric_limits<double>::infinity(), 0.};
    DenseMatrix short_waves =
        short_wave_compliance(grid, HalfSpacePair(contact->material, rigid_body), (N + 0.5) / radius);
    turn_with_tread(short_waves);
    result.compliance.add(1., short_waves);
    for (unsigned int j = 0; j < 3 * n_points; ++j)
      for (unsigned int i = 0; i < j; ++i)
        result.compliance(i, j) = result.compliance(j, i) =
            (result.compliance(i, j) + result.compliance(j, i)) / 2;

    // the whole body follows its held boundary
    result.lifting.assign(3 * n_points, 0.);
    std::fill_n(result.lifting.begin(), n_points, 1.);
    result.surface_height = contact->surface_height;
    run_log().line("contact compliance of " + std::to_string(3 * n_points) + " rows by " +
                   std::to_string(N + 1) + " harmonics: " + time_text(timer.wall_time()));
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

  std::vector<RevolvedReduction::WaveMode> RevolvedReduction::modes_of(const unsigned int n,
                                                                       const ModeParameters &parameters,
                                                                       const WheelFrame &frame,
                                                                       const Vector *const stretched) const
  {
    const auto system = section->system(n);
    Flexibility flexibility(*system);
    const Modes modes = compute_modes(*system, flexibility, parameters);
    const auto rotation = stretched ? section->rotation(n, *stretched) : nullptr;
    const std::vector<double> damping_ratio = strain_energy_damping(*system, modes);
    const std::vector<TraceRow> boundary = section->boundary(n).rows;
    const auto &places = section->positions();
    const auto &components = section->components();
    const unsigned int n_dofs = places.size();

    Vector diagonal(system->locally_owned, MPI_COMM_SELF), along(diagonal), inertia(diagonal);
    MatGetDiagonal(system->mass, diagonal);
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
      mode.damping_ratio = damping_ratio[k];
      mode.orthonormality_error = modes.orthonormality_error;
      mode.residual = modes.residual;
      mode.tread = values_of(tread_rows, shape);
      mode.boundary = values_of(boundary, shape);
      for (const bool odd : {false, true})
        if (const auto weight = section->weight(n, odd))
          mode.load[odd] = shape * *weight;
      // unit translations: along y with n = 0; z = -r cos + t sin and x = r sin + t cos with n = 1
      along = 0;
      for (unsigned int i = 0; i < n_dofs && n < 2; ++i)
        along(i) = n == 0 ? components[i] == RevolvedSection::axial
                          : (components[i] == RevolvedSection::radial) -
                                (components[i] == RevolvedSection::circumferential);
      along.compress(dealii::VectorOperation::insert);
      system->mass.vmult(inertia, along);
      const double participation = shape * inertia;
      if (n == 0)
        mode.even[1] = participation;
      if (n == 1)
      {
        mode.even[2] = -participation;
        mode.odd[0] = participation;
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

  std::vector<RevolvedReduction::WaveMode> RevolvedReduction::all_modes(const ModeParameters &parameters,
                                                                        const WheelFrame &frame,
                                                                        const bool rotates) const
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
            const Alone alone;
            const auto still = section->system(0);
            Flexibility flexibility(*still);
            const Vector load = section->centrifugal_load();
            stretched.emplace(load);
            flexibility.vmult(*stretched, load);
          },
          communicator);
    for (unsigned int n = 0, empty = 0; empty < empty_in_a_row;)
    {
      std::vector<WaveMode> own;
      on_all_ranks(
          [&]
          {
            const Alone alone;
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

  ModalReduction RevolvedReduction::modes(const ModeParameters &parameters, const WheelFrame &frame,
                                          SurfaceShapes &shapes, FlowReduction *const flow) const
  {
    dealii::Timer timer;
    const std::vector<WaveMode> modes = all_modes(parameters, frame, flow != nullptr);
    ModalReduction result;
    result.n_dofs = section->n_dofs();
    std::vector<WheelLabel> labels;
    std::vector<std::vector<double>> traces;
    std::vector<const std::vector<double> *> participations;
    for (const WaveMode &mode : modes)
      for (const bool odd : {false, true})
      {
        if (odd && mode.n == 0)
          continue;
        result.omega.push_back(mode.omega);
        result.damping_ratio.push_back(mode.damping_ratio);
        labels.push_back({mode.family, mode.nodal_circles, mode.n});
        result.load.push_back(mode.load[odd]);
        participations.push_back(odd ? &mode.odd : &mode.even);
        result.orthonormality_error = std::max(result.orthonormality_error, mode.orthonormality_error);
        result.residual = std::max(result.residual, mode.residual);
        if (!contact)
          continue;
        const DenseMatrix spread = around(mode.n, odd);
        DenseVector at_points(spread.m());
        spread.vmult(at_points, DenseVector(mode.tread.begin(), mode.tread.end()));
        traces.emplace_back(at_points.begin(), at_points.end());
      }
    const unsigned int n_modes = result.omega.size();
    result.participation.reinit(n_modes, 3);
    for (unsigned int k = 0; k < n_modes; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        result.participation(k, d) = (*participations[k])[d];
    result.trace.reinit(contact ? 3 * contact->grid.n_points() : 0, n_modes);
    for (unsigned int k = 0; k < traces.size(); ++k)
      std::copy(traces[k].begin(), traces[k].end(), &result.trace(0, k));
    result.labels = unique_texts(labels);
    const std::vector<double> by_diameters = wheel_damping(labels, parameters);
    for (unsigned int k = 0; k < n_modes; ++k)
      result.damping_ratio[k] += by_diameters[k];
    shapes = surface_shapes(modes);
    if (flow)
      *flow = flow_of(modes);
    result.seconds = timer.wall_time();
    run_log().line(std::to_string(n_modes) + " modes by harmonics: " + time_text(result.seconds) +
                   "; orthonormality error " + number_text(result.orthonormality_error) + ", residual " +
                   number_text(result.residual));
    return result;
  }

  FlowReduction RevolvedReduction::flow_of(const std::vector<WaveMode> &modes) const
  {
    FlowReduction flow;
    std::vector<unsigned int> first;
    for (const WaveMode &mode : modes)
    {
      first.push_back(flow.omega.size());
      const unsigned int copies = mode.n == 0 ? 1 : 2;
      flow.omega.resize(first.back() + copies, mode.omega);
      flow.names.resize(first.back() + copies, WheelLabel{mode.family, mode.nodal_circles, mode.n}.text());
    }
    for (auto *const matrix : {&flow.fixed, &flow.turning, &flow.of_square})
      matrix->reinit(flow.omega.size(), flow.omega.size());
    for (unsigned int a = 0; a < modes.size(); ++a)
      for (unsigned int b = 0; b < modes.size(); ++b)
      {
        const unsigned int n = modes[a].n, k = first[a], l = first[b];
        if (modes[b].n != n)
          continue;
        const double coupling = modes[a].coriolis[modes[b].number],
                     square = modes[a].of_square[modes[b].number];
        flow.of_square(k, l) = square;
        if (n == 0)
        {
          flow.fixed(k, l) = coupling;
          continue;
        }
        flow.of_square(k + 1, l + 1) = square;
        flow.fixed(k, l + 1) = coupling;
        flow.fixed(l + 1, k) = -coupling;
        if (a == b)
        {
          flow.turning(k, k + 1) = n;
          flow.turning(k + 1, k) = -double(n);
        }
      }
    return flow;
  }

  SurfaceShapes RevolvedReduction::surface() const
  {
    return surface_shapes({});
  }

  SurfaceShapes RevolvedReduction::surface_shapes(const std::vector<WaveMode> &modes) const
  {
    unsigned int n_angles = fewest_angles;
    for (const WaveMode &mode : modes)
      n_angles = std::max(n_angles, angles_per_wave * mode.n);
    const RevolvedSection::Boundary boundary = section->boundary(0);
    const unsigned int n_around = boundary.points.size();
    SurfaceShapes result;
    const auto angle = [&](const unsigned int k) { return 2 * dealii::numbers::PI * k / n_angles; };
    for (unsigned int k = 0; k < n_angles; ++k)
    {
      for (const auto &point : boundary.points)
        result.points.insert(result.points.end(), {point[1] * std::sin(angle(k)), point[0] - lateral_position,
                                                   radius - point[1] * std::cos(angle(k))});
      const int here = k * n_around, next = (k + 1) % n_angles * n_around;
      for (const auto &edge : boundary.edges)
        result.quads.insert(result.quads.end(), {here + int(edge[0]), here + int(edge[1]),
                                                 next + int(edge[1]), next + int(edge[0])});
    }
    for (const WaveMode &mode : modes)
      for (const bool odd : {false, true})
      {
        if (odd && mode.n == 0)
          continue;
        result.omega.push_back(mode.omega);
        for (unsigned int k = 0; k < n_angles; ++k)
        {
          const double theta = angle(k), c = std::cos(mode.n * theta), s = std::sin(mode.n * theta);
          // n = 0: both families in one
          const double across = odd ? s : c, along = mode.n == 0 ? -1. : odd ? -c : s;
          for (unsigned int i = 0; i < n_around; ++i)
          {
            const double u_a = across * mode.boundary[3 * i], u_r = across * mode.boundary[3 * i + 1],
                         u_t = along * mode.boundary[3 * i + 2];
            result.shapes.push_back(float(u_r * std::sin(theta) + u_t * std::cos(theta)));
            result.shapes.push_back(float(u_a));
            result.shapes.push_back(float(-u_r * std::cos(theta) + u_t * std::sin(theta)));
          }
        }
      }
    return result;
  }
} // namespace vibrocontact
