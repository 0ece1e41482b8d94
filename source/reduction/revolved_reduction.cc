#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/short_waves.h>
#include <vibrocontact/reduction/revolved_point.h>
#include <vibrocontact/reduction/revolved_reduction.h>
#include <vibrocontact/reduction/wave_mode.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;
  namespace MPI = dealii::Utilities::MPI;

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
      for (unsigned int component = 0; component < 3; ++component)
      {
        const std::array<double, 3> weights = wave_weights(n, odd, theta, half, component);
        for (unsigned int c = 0; c < 3; ++c)
          result(contact_row(n_points, component, i), c * n_y + i / grid.n_x) = weights[c];
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
            const LoneWave alone;
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
    short_waves.add(1., short_wave_curvature(grid, contact->material, radius, (N + 0.5) / radius));
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
} // namespace vibrocontact
