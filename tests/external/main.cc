// Vibrocontact with one more member of each family: appended to the tables, unknown to the library (doc/extending.md).

#include <vibrocontact/analyses/modes/modal.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/contact/laws/derivative.h>
#include <vibrocontact/contact/newton.h>
#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/run/entries_of_bodies.h>
#include <vibrocontact/run/program.h>

#include <deal.II/base/utilities.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  // ---------------------------------------------------------------- a normal law: N = k d

  class OwnSpring : public SpringLaw
  {
  public:
    explicit OwnSpring(const double k) : k(k) {}
    LawDescription description() const override { return {"own spring", {k}}; }

  protected:
    Spring spring(const double penetration) const override { return {k * penetration, k}; }

  private:
    const double k;
  };

  NormalLawEntry own_spring()
  {
    return {"own spring",
            "force = stiffness * penetration",
            {law_number("Own stiffness", "1e6", "Of the own spring. Units: N/m.", 1e-6, 1e15)},
            [](const std::vector<double> &numbers)
            { return std::make_shared<const OwnSpring>(numbers.at(0)); }};
  }

  // ---------------------------------------------------------------- a friction law: from rest to sliding

  class OwnFriction : public FrictionLaw
  {
  public:
    OwnFriction(const double mu, const double ratio) : mu(mu), ratio(ratio) {}
    LawDescription description() const override { return {"own friction", {mu, ratio}}; }
    Coefficient coefficient(const double speed) const override
    {
      const auto [value, slope] = value_and_slope([this](const auto &s) { return over_speed(s); }, speed);
      return {value, slope};
    }

  private:
    template <typename Number>
    Number over_speed(const Number &s) const
    {
      using std::exp;
      return mu * (1 + (ratio - 1) * exp(-s / 0.1));
    }

    const double mu, ratio;
  };

  FrictionLawEntry own_friction()
  {
    return {
        "own friction",
        "falls within 0.1 m/s",
        {friction_coefficient(),
         law_number("Own ratio", "1.5", "Friction at rest over Friction coefficient. Units: none.", 1, 10)},
        [](const std::vector<double> &numbers)
        { return std::make_shared<const OwnFriction>(numbers.at(0), numbers.at(1)); }};
  }

  // ---------------------------------------------------------------- a body: a rod of two-node elements, held at its far end

  class Rod : public ElementBody
  {
  public:
    double length = 1, section = 1;
    unsigned int divisions = 10;

    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      using namespace dealii::Patterns;
      prm.add_parameter("Length", length, "Of the rod. Units: m.", Double(1e-9, 1e6));
      prm.add_parameter("Section", section, "Its area. Units: m^2.", Double(1e-18, 1e6));
      prm.add_parameter("Divisions", divisions, "Elements. Units: none.", Integer(1, 100000));
    }
    void check(const std::string &where) const override
    {
      if (divisions < 2)
        throw InputError(where + "/Divisions is 1, but a rod has two elements or more: raise it.");
    }
    std::optional<ContactGrid> contact_points(double) const override
    {
      return single_point(std::sqrt(section));
    }
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, const bool above,
                                                const ContactGrid *const grid,
                                                const MPI_Comm communicator) const override
    {
      using namespace dealii;
      const unsigned int n = divisions + 1;
      const double h = length / divisions, k = body.material.young_modulus * section / h,
                   m = body.material.density * section * h;
      auto system = std::make_unique<SecondOrderSystem>();
      system->body = body.name;
      system->communicator = communicator;
      system->locally_owned = Utilities::create_evenly_distributed_partitioning(
          Utilities::MPI::this_mpi_process(communicator), Utilities::MPI::n_mpi_processes(communicator), n);
      DynamicSparsityPattern pattern(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = (i == 0 ? 0 : i - 1); j < std::min(n, i + 2); ++j)
          pattern.add(i, j);
      for (auto *const matrix : {&system->mass, &system->stiffness})
        matrix->reinit(system->locally_owned, system->locally_owned, pattern, communicator);
      for (const auto i : system->locally_owned)
      {
        // a held dof keeps its diagonal entry and has no mass
        const bool end = i == 0, held = i + 1 == n;
        system->stiffness.add(i, i, end || held ? k : 2 * k);
        if (!held)
          system->mass.add(i, i, end ? m / 2 : m);
        if (i > 0 && !held)
          system->stiffness.add(i, i - 1, -k);
        if (i + 2 < n)
          system->stiffness.add(i, i + 1, -k);
        system->dof_position.emplace_back(0., 0., (above ? 1 : -1) * h * i);
        system->dof_direction.push_back(2);
      }
      system->mass.compress(VectorOperation::add);
      system->stiffness.compress(VectorOperation::add);
      system->total_mass = divisions * m;
      system->follows_hub = true;
      if (grid)
      {
        system->trace.grid = *grid;
        system->trace.rows.resize(3);
        system->trace.rows[0] = {{0, 1.}};
        system->trace.surface_height = {0.};
      }
      return system;
    }
  };

  BodyType rod()
  {
    return {"rod", "Rod", "straight rod along z, far end held", [] { return std::make_shared<Rod>(); }};
  }

  // ---------------------------------------------------------------- an analysis: the wave speed that a mode means

  struct WaveSpeedParameters : ParameterGroup
  {
    unsigned int mode = 1;

    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Mode", mode, "Mode that is looked at, from 1. Units: none.",
                        dealii::Patterns::Integer(1));
    }
    void check(const std::string &) const override {}
  };

  void wave_speed_read(EntriesRead &entries, const Parameters &parameters)
  {
    BodyUse use;
    use.motion = true;
    add_body(entries, parameters, 0, use);
  }

  // omega_k = 2 c / h sin((2 k - 1) pi / (4 n)) of n lumped elements
  void run_wave_speed(const AnalysisRun &on)
  {
    const auto &own =
        dynamic_cast<const WaveSpeedParameters &>(*on.parameters.scene.own_parameters.at("wave speed"));
    const auto *const body = dynamic_cast<const Rod *>(on.parameters.scene.bodies[0].description.get());
    if (!body)
      throw InputError("Analyses lists wave speed, but " + on.parameters.scene.bodies[0].name +
                       " is no rod: make it one.");
    run_log().block("Wave speed");
    const ModalResult modes = modal_analysis(*on.bodies[0]);
    const double omega = 2 * M_PI * modes.frequencies_Hz.at(own.mode - 1), n = body->divisions,
                 speed = omega * body->length / n / (2 * std::sin((2 * own.mode - 1) * M_PI / (4 * n)));
    run_log().value("wave speed", speed, "m/s");
    on.results.analyses["wave_speed"] = {{"mode", own.mode}, {"speed_m_s", speed}};
  }

  std::vector<std::string> wave_speed_answer(const nlohmann::ordered_json &json)
  {
    return {"waves run at " + std::to_string(json["speed_m_s"].get<double>()) + " m/s"};
  }

  Analysis wave_speed()
  {
    Analysis row;
    row.type = {"wave speed", "of a rod, from one of its modes", 1};
    row.type.section = "Wave speed";
    row.type.make_parameters = [] { return std::make_shared<WaveSpeedParameters>(); };
    row.reads = wave_speed_read;
    row.run = run_wave_speed;
    row.continues = false;
    row.answers = {{"wave_speed", "wave speed", wave_speed_answer, {}}};
    return row;
  }

  // ---------------------------------------------------------------- a propagator

  class Forwarding : public Propagator
  {
  public:
    explicit Forwarding(std::unique_ptr<Propagator> propagator) : propagator(std::move(propagator))
    {
      one_step = this->propagator->compliance();
      take();
    }
    void advance(const double *const q) override
    {
      propagator->advance(q);
      take();
    }
    void exchange(CheckpointFile &file) override
    {
      propagator->exchange(file);
      take();
    }

  private:
    void take() { free.assign(propagator->free_displacement(), propagator->free_displacement() + n_rows()); }
    const std::unique_ptr<Propagator> propagator;
  };

  PropagatorType own_propagator()
  {
    return {"own propagator", "hands on to modal recursion", false, false,
            [](const auto &model, const auto &state, const auto &settings) -> std::unique_ptr<Propagator> {
              return std::make_unique<Forwarding>(
                  create_propagator("modal recursion", model, state, settings));
            }};
  }

  // ---------------------------------------------------------------- a basis in time

  class OwnBasis : public TimeBasis
  {
  public:
    explicit OwnBasis(const unsigned int n) : TimeBasis(n), splines(create_time_basis("bspline", n)) {}
    std::string name() const override { return "own splines"; }
    unsigned int n_derivatives() const override { return splines->n_derivatives(); }
    const RefinableFunction *scaling_function() const override { return splines->scaling_function(); }
    std::vector<std::complex<double>> values(const double phase, const unsigned int d) const override
    {
      return splines->values(phase, d);
    }
    std::complex<double> fourier_coefficient(const unsigned int m, const int l) const override
    {
      return splines->fourier_coefficient(m, l);
    }
    double function(const unsigned int k, const double phase, const unsigned int d) const override
    {
      return splines->function(k, phase, d);
    }

  private:
    const std::unique_ptr<const TimeBasis> splines;
  };

  TimeBasisEntry own_basis()
  {
    return {"own splines", "cubic splines of another name",
            [](const unsigned int n) { return std::make_unique<const OwnBasis>(n); }};
  }

  // ---------------------------------------------------------------- a contact solver

  ContactSolverEntry own_solver()
  {
    return {"own newton", "semi-smooth newton from nothing",
            [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
            { return std::make_unique<NewtonSolver>(p); }};
  }

  // ---------------------------------------------------------------- a recorder: the largest normal force

  class LargestForce : public StateRecorder
  {
  public:
    explicit LargestForce(const std::string &folder) : file(folder + "/largest_force.csv") {}
    void add(const DynamicState &state) override
    {
      double force = 0;
      for (unsigned int i = 0; i < state.R.size() / 3; ++i)
        force += state.R[i];
      largest = std::max(largest, force);
    }
    void exchange(CheckpointFile &checkpoint) override { checkpoint("largest_force", largest); }
    void finish(bool) override
    {
      Table table({"largest_force_N"}, {"Largest normal force of the run"});
      table.add_row({largest});
      table.write(file);
    }

  private:
    const std::string file;
    double largest = 0;
  };
} // namespace

int main(int argc, char **argv)
{
  Tables tables = standard_tables();
  tables.laws.normal.push_back(own_spring());
  tables.laws.friction.push_back(own_friction());
  tables.body_types.push_back(rod());
  tables.propagator_types.push_back(own_propagator());
  tables.time_bases.push_back(own_basis());
  tables.contact_solvers.push_back(own_solver());
  tables.analyses.push_back(wave_speed());
  tables.recorders.push_back([](const RecordedTransient &on)
                             { return std::make_unique<LargestForce>(on.folder); });
  return run_program(tables, argc, argv);
}
