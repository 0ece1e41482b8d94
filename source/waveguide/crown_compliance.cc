#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/contact/short_waves.h>
#include <vibrocontact/waveguide/crown_compliance.h>
#include <vibrocontact/waveguide/plane_section.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/sparse_direct.h>

#include <cmath>
#include <limits>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// longest wave that gets an octave of its own; those beyond it share one interval [rad/m]
    constexpr double longest = 0.5;

    struct WaveNumber
    {
      double k, weight;
    };

    std::vector<WaveNumber> wave_numbers(const CrownWaves &waves)
    {
      const QGauss<1> gauss(waves.points_per_octave);
      std::vector<WaveNumber> result;
      for (double from = 0, to = std::min(longest, waves.shortest); from < waves.shortest;
           from = to, to = std::min(2 * to, waves.shortest))
        for (unsigned int q = 0; q < gauss.size(); ++q)
          result.push_back({from + (to - from) * gauss.point(q)[0], (to - from) * gauss.weight(q)});
      return result;
    }

    /// r^T (K(k) + bed)^-1 r in the real form of motion_stiffness(); 3 n_y square
    DenseMatrix answer(const SectionElements &elements, const SparseMatrix<double> &bed,
                       const std::vector<Vector<double>> &rows, const double k)
    {
      SparseMatrix<double> K(elements.pattern);
      elements.motion_stiffness(k, k * k, true, K);
      K.add(1, bed);
      SparseDirectUMFPACK inverse;
      inverse.initialize(K);
      const unsigned int n = rows.size();
      DenseMatrix result(n, n);
      Vector<double> motion(elements.n_dofs());
      for (unsigned int j = 0; j < n; ++j)
      {
        inverse.vmult(motion, rows[j]);
        for (unsigned int i = 0; i < n; ++i)
          result(i, j) = rows[i] * motion;
      }
      return result;
    }
  } // namespace

  DenseMatrix crown_compliance(const SectionElements &elements, const std::array<double, 3> &bed,
                               const double lateral_position, const ContactGrid &grid,
                               const HalfSpaceMaterial &material, const CrownWaves &waves)
  {
    const unsigned int n = grid.n_points(), n_x = grid.n_x, n_y = grid.n_y;
    // directions as in contact rows: z, x, y
    constexpr unsigned int directions[3] = {2, 0, 1};
    std::vector<Vector<double>> rows;
    for (const unsigned int direction : directions)
      for (unsigned int j = 0; j < n_y; ++j)
      {
        const double y = lateral_position + grid.y_first + j * grid.spacing_y;
        rows.push_back(elements.boundary_load(section_boundary::crown, y - grid.spacing_y / 2,
                                              y + grid.spacing_y / 2, direction));
        rows.back() /= grid.spacing_y;
      }
    SparseMatrix<double> springs(elements.pattern), one(elements.pattern);
    for (unsigned int d = 0; d < 3; ++d)
    {
      one = 0;
      elements.boundary_springs(section_boundary::foot, d, one);
      springs.add(bed[d], one);
    }

    // by distance along x in cells: [lag + n_x - 1], 3 n_y square
    std::vector<DenseMatrix> by_lag(2 * n_x - 1, DenseMatrix(3 * n_y, 3 * n_y));
    const std::vector<WaveNumber> all = wave_numbers(waves);
    const MPI_Comm communicator = run_communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    on_all_ranks(
        [&]
        {
          for (unsigned int w = Utilities::MPI::this_mpi_process(communicator); w < all.size(); w += n_ranks)
          {
            const double k = all[w].k, half = k * grid.spacing_x / 2, spread = std::sin(half) / half;
            const DenseMatrix C = answer(elements, springs, rows, k);
            for (unsigned int l = 0; l < by_lag.size(); ++l)
            {
              const double phase = k * grid.spacing_x * (double(l) - (n_x - 1.)),
                           factor = all[w].weight / numbers::PI * spread * spread,
                           even = factor * std::cos(phase), odd = factor * std::sin(phase);
              for (unsigned int b = 0; b < 3 * n_y; ++b)
                for (unsigned int a = 0; a < 3 * n_y; ++a)
                {
                  const bool axial_a = a / n_y == 1, axial_b = b / n_y == 1;
                  by_lag[l](a, b) += (axial_a == axial_b ? even : axial_a ? -odd : odd) * C(a, b);
                }
            }
          }
        },
        communicator);
    for (DenseMatrix &lag : by_lag)
    {
      std::vector<double> entries(&lag(0, 0), &lag(0, 0) + std::size_t(9) * n_y * n_y);
      Utilities::MPI::sum(entries, communicator, entries);
      std::copy(entries.begin(), entries.end(), &lag(0, 0));
    }

    const HalfSpaceMaterial rigid = {std::numeric_limits<double>::infinity(), 0.};
    DenseMatrix result = short_wave_compliance(grid, HalfSpacePair(rigid, material), waves.shortest);
    for (unsigned int q = 0; q < 3 * n; ++q)
      for (unsigned int p = 0; p < 3 * n; ++p)
      {
        const unsigned int i = p % n, j = q % n, a = p / n * n_y + i / n_x, b = q / n * n_y + j / n_x;
        result(p, q) += by_lag[i % n_x + n_x - 1 - j % n_x](a, b);
      }
    for (unsigned int q = 0; q < 3 * n; ++q)
      for (unsigned int p = 0; p < q; ++p)
        result(p, q) = result(q, p) = (result(p, q) + result(q, p)) / 2;
    return result;
  }
} // namespace vibrocontact
