#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/fe/ring_elements.h>
#include <vibrocontact/scene/body.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <array>
#include <cmath>
#include <map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_cell = 8;
    using Row = std::array<double, n_cell>;

    /// Derivatives of v and w along theta at a place of an element, in terms of its dofs: of either node u_x,
    /// u_z, slope of v, slope of w (per element).
    struct Fields
    {
      /// d^k v / dtheta^k, d^k w / dtheta^k
      std::array<Row, 3> v{}, w{};
    };

    class BeamRing
    {
    public:
      explicit BeamRing(const RingParameters &ring)
          : ring(ring), n(ring.divisions), step(2 * numbers::PI / n),
            basis(Polynomials::HermiteInterpolation::generate_complete_basis(3))
      {
      }

      unsigned int n_dofs() const { return 4 * n; }
      std::array<types::global_dof_index, n_cell> dofs(const unsigned int element) const
      {
        std::array<types::global_dof_index, n_cell> result;
        for (unsigned int k = 0; k < n_cell; ++k)
          result[k] = 4 * ((element + k / 4) % n) + k % 4;
        return result;
      }

      /// @param xi 0 to 1 in the element
      Fields fields(const unsigned int element, const double xi) const
      {
        Fields result;
        std::vector<double> value(3);
        for (unsigned int node = 0; node < 2; ++node)
        {
          const double theta = (element + node) * step, c = std::cos(theta), s = std::sin(theta);
          const unsigned int first = 4 * node;
          basis[node].value(xi, value);
          for (unsigned int d = 0; d < 3; ++d)
          {
            const double N = value[d] / std::pow(step, d);
            result.v[d][first] = c * N;
            result.v[d][first + 1] = s * N;
            result.w[d][first] = s * N;
            result.w[d][first + 1] = -c * N;
          }
          basis[2 + node].value(xi, value);
          for (unsigned int d = 0; d < 3; ++d)
            result.v[d][first + 2] = result.w[d][first + 3] = value[d] / std::pow(step, d);
        }
        return result;
      }

      std::pair<unsigned int, double> find(const double theta) const
      {
        const double place = theta / step - n * std::floor(theta / step / n);
        const unsigned int element = std::min(static_cast<unsigned int>(place), n - 1);
        return {element, place - element};
      }

      Point<3> position(const double theta) const
      {
        return {ring.radius * std::sin(theta), 0., ring.radius * (1 - std::cos(theta))};
      }

      const RingParameters &ring;
      const unsigned int n;
      const double step;

    private:
      const std::vector<Polynomials::Polynomial<double>> basis;
    };

    Row sum(const Row &a, const Row &b, const double factor)
    {
      Row result;
      for (unsigned int k = 0; k < n_cell; ++k)
        result[k] = a[k] + factor * b[k];
      return result;
    }

    void add(FullMatrix<double> &matrix, const double factor, const Row &a, const Row &b)
    {
      for (unsigned int k = 0; k < n_cell; ++k)
        for (unsigned int l = 0; l < n_cell; ++l)
          matrix(k, l) += factor * (a[k] * b[l] + b[k] * a[l]) / 2;
    }
    void add(FullMatrix<double> &matrix, const double factor, const Row &a)
    {
      add(matrix, factor, a, a);
    }

    /// weight [m] times the energies of scene/ring.h
    void add_energies(FullMatrix<double> &stiffness, FullMatrix<double> &mass, const RingParameters &ring,
                      const Fields &at, const double weight)
    {
      const Row &v = at.v[0], &w = at.w[0];
      const Row strain = sum(at.v[1], w, 1), turn = sum(at.w[1], v, -1);
      const double t = weight * ring.tension();
      add(stiffness, weight * ring.bending(), sum(at.w[2], at.v[1], -1));
      add(stiffness, weight * ring.membrane() + t, strain);
      add(stiffness, t, turn);
      const double inside = ring.pressure_follows() ? t : 0;
      add(stiffness, weight * ring.radial_stiffness - inside, w);
      add(stiffness, weight * ring.circumferential_stiffness - inside, v);
      add(stiffness, -inside, w, at.v[1]);
      add(stiffness, inside, v, at.w[1]);
      add(mass, weight * ring.line_density(), w);
      add(mass, weight * ring.line_density(), v);
    }

    /// factor times the antisymmetric part of a b.
    void add_flow(FullMatrix<double> &matrix, const double factor, const Row &a, const Row &b)
    {
      for (unsigned int k = 0; k < n_cell; ++k)
        for (unsigned int l = 0; l < n_cell; ++l)
          matrix(k, l) += factor * (a[k] * b[l] - b[k] * a[l]) / 2;
    }

    /// G of an element: of the components v, w, and with the turning of e_theta and e_r, e_theta' = -e_r, e_r' = e_theta.
    void add_flow(FullMatrix<double> &fixed, FullMatrix<double> &turning, const double factor,
                  const Fields &at)
    {
      for (FullMatrix<double> *const matrix : {&fixed, &turning})
      {
        add_flow(*matrix, factor, at.v[0], at.v[1]);
        add_flow(*matrix, factor, at.w[0], at.w[1]);
      }
      add_flow(fixed, 2 * factor, at.v[0], at.w[0]);
    }

    TraceRow dof_row(const BeamRing &beam, const unsigned int element, const Row &row, const double factor)
    {
      std::map<types::global_dof_index, double> result;
      const auto dofs = beam.dofs(element);
      for (unsigned int k = 0; k < n_cell; ++k)
        if (row[k] != 0)
          result[dofs[k]] += factor * row[k];
      return {result.begin(), result.end()};
    }
  } // namespace

  std::unique_ptr<SecondOrderSystem> assemble_beam_ring(const RingParameters &ring, const std::string &name,
                                                        const ContactGrid *const grid,
                                                        const MPI_Comm communicator)
  {
    // The mesh is small and known everywhere; each rank assembles its share of the rows.
    const BeamRing beam(ring);
    auto system = std::make_unique<SecondOrderSystem>();
    system->body = name;
    system->communicator = communicator;
    system->locally_owned = Utilities::create_evenly_distributed_partitioning(
        Utilities::MPI::this_mpi_process(communicator), Utilities::MPI::n_mpi_processes(communicator),
        beam.n_dofs());
    DynamicSparsityPattern pattern(beam.n_dofs());
    for (unsigned int e = 0; e < beam.n; ++e)
      for (const auto row : beam.dofs(e))
        for (const auto column : beam.dofs(e))
          pattern.add(row, column);
    const auto flow = ring.rolling ? std::make_shared<MaterialFlow>() : nullptr;
    std::vector<PETScWrappers::MPI::SparseMatrix *> matrices = {&system->mass, &system->stiffness};
    if (flow)
      matrices.insert(matrices.end(), {&flow->fixed, &flow->turning});
    for (auto *const matrix : matrices)
      matrix->reinit(system->locally_owned, system->locally_owned, pattern, communicator);

    const QGauss<1> gauss(4); // exact
    for (unsigned int e = 0; e < beam.n; ++e)
    {
      std::vector<FullMatrix<double>> own(4, FullMatrix<double>(n_cell));
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Fields at = beam.fields(e, gauss.point(q)[0]);
        const double length = gauss.weight(q) * beam.step * ring.radius;
        add_energies(own[1], own[0], ring, at, length);
        add_flow(own[2], own[3], length * ring.line_density(), at);
      }
      const auto dofs = beam.dofs(e);
      for (unsigned int a = 0; a < n_cell; ++a)
        if (system->locally_owned.is_element(dofs[a]))
          for (unsigned int b = 0; b < n_cell; ++b)
            for (unsigned int k = 0; k < matrices.size(); ++k)
              matrices[k]->add(dofs[a], dofs[b], own[k](a, b));
    }
    for (auto *const matrix : matrices)
      matrix->compress(VectorOperation::add);
    if (ring.damping_ratio > 0)
    {
      system->loss_stiffness.reinit(system->stiffness);
      system->loss_stiffness.copy_from(system->stiffness);
      system->loss_stiffness *= 2 * ring.damping_ratio;
      system->has_loss = true;
    }
    system->total_mass = 2 * numbers::PI * ring.radius * ring.line_density();

    // in the mirror x -> -x the slope of v stays and that of w changes its sign, as rotations about x and y do
    const unsigned char direction[] = {0, 2, 3, 4};
    for (const auto dof : system->locally_owned)
    {
      system->dof_position.push_back(beam.position(dof / 4 * beam.step));
      system->dof_direction.push_back(direction[dof % 4]);
    }
    SurfaceTrace &line = system->surface;
    for (unsigned int i = 0; i < beam.n; ++i)
    {
      line.points.push_back(beam.position(i * beam.step));
      line.rows.insert(line.rows.end(), {{{4 * i, 1.}}, {}, {{4 * i + 1, 1.}}});
      const int next = (i + 1) % beam.n, own = i;
      line.quads.push_back({{own, next, next, own}});
    }
    if (grid)
    {
      system->trace.grid = *grid;
      system->trace.faces_up = false;
      system->trace.rows.resize(3 * ring.n_points);
      system->trace.surface_height.assign(ring.n_points, 0.);
      const std::vector<double> angles = ring.angles();
      for (unsigned int i = 0; i < angles.size(); ++i)
      {
        const auto [element, xi] = beam.find(angles[i]);
        const Fields at = beam.fields(element, xi);
        system->trace.rows[contact_row(ring.n_points, 0, i)] = dof_row(beam, element, at.w[0], -1);
        system->trace.rows[contact_row(ring.n_points, 1, i)] = dof_row(beam, element, at.v[0], 1);
        system->trace.surface_height[i] = beam.position(angles[i])[2];
        if (flow)
          flow->stretch.push_back(dof_row(beam, element, sum(at.v[1], at.w[0], 1), 1 / ring.radius));
      }
      if (flow)
        for (const double angle : ring.angles_beyond())
        {
          const auto [element, xi] = beam.find(angle);
          flow->beyond.push_back(dof_row(beam, element, beam.fields(element, xi).v[0], 1));
        }
    }
    system->flow = flow;
    return system;
  }

  std::unique_ptr<SecondOrderSystem> assemble_ring(const RingParameters &ring, const std::string &name,
                                                   const ContactGrid *const grid, const MPI_Comm communicator)
  {
    AssertThrow(ring.is_meshed(), ExcMessage("The analytic ring has no elements."));
    return ring.model == "beam elements" ? assemble_beam_ring(ring, name, grid, communicator)
                                         : assemble_solid_ring(ring, name, grid, communicator);
  }

  std::unique_ptr<SecondOrderSystem> RingParameters::assemble(const BodyParameters &body, bool,
                                                              const ContactGrid *const grid,
                                                              const MPI_Comm communicator) const
  {
    return assemble_ring(*this, body.name, grid, communicator);
  }
} // namespace vibrocontact
