#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/few_points.h>
#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>
#include <vibrocontact/contact/projected_jacobi.h>

namespace vibrocontact
{
  namespace
  {
    /// The first of some rows that takes a problem. Where it does not converge the next one that takes it goes on from its best
    /// state (declared: counted as a fallback).
    class FirstThatTakes : public ContactSolver
    {
    public:
      FirstThatTakes(ContactSolvers rows, const ContactSolverParameters &parameters)
          : rows(std::move(rows)), solvers(this->rows.size()), parameters(parameters)
      {
      }

      void solve(const ContactProblem &problem, ContactSolution &state) override
      {
        unsigned int k = next(problem, 0);
        check_taken(problem, k);
        solver(k).solve(problem, state);
        while (!state.converged && (k = next(problem, k + 1)) < rows.size())
        {
          const SolverCost before = state.cost();
          solver(k).solve(problem, state);
          state.cost() += before;
          ++state.fallbacks;
        }
      }

      void prepare(const ContactProblem &problem) override
      {
        const unsigned int k = next(problem, 0);
        check_taken(problem, k);
        solver(k).prepare(problem);
      }

      void renew() override
      {
        for (const auto &one : solvers)
          if (one)
            one->renew();
      }

      void exchange(CheckpointFile &file) override
      {
        for (const auto &one : solvers)
          if (one)
            one->exchange(file);
      }

    private:
      unsigned int next(const ContactProblem &problem, unsigned int k) const
      {
        while (k < rows.size() && rows[k].takes && !rows[k].takes(problem))
          ++k;
        return k;
      }

      void check_taken(const ContactProblem &problem, const unsigned int k) const
      {
        if (k == rows.size())
          throw InputError("Contact/Solver/Method is " + rows.back().name + ", which takes " +
                           rows.back().asks_for + " alone, but the contact problem '" + problem.title +
                           "' is another: leave Method at automatic.");
      }

      ContactSolver &solver(const unsigned int k)
      {
        if (!solvers[k])
          solvers[k] = rows[k].create(parameters);
        return *solvers[k];
      }

      const ContactSolvers rows;
      std::vector<std::unique_ptr<ContactSolver>> solvers;
      const ContactSolverParameters parameters;
    };

    template <typename Solver>
    std::unique_ptr<ContactSolver> make(const ContactSolverParameters &parameters)
    {
      return std::make_unique<Solver>(parameters);
    }

    ContactSolverEntry active_set()
    {
      return {"active set",
              "the closed set of the step before, corrected; up to four points in closed form",
              make<ActiveSetSolver>,
              ActiveSetSolver::takes,
              "the rigid points of a road without friction, with a dense matrix and a given approach,",
              ""};
    }

    ContactSolverEntry projected_jacobi()
    {
      return {"projected jacobi",
              "steps that shrink errors tenfold at least, a product with the matrix each",
              make<ProjectedJacobi>,
              ProjectedJacobi::takes,
              "rigid points evenly apart on a body that is alike everywhere and yields a tenth of their "
              "tread at most, without friction and with a given approach,",
              "Tolerance",
              1};
    }

    ContactSolverEntry few_points()
    {
      return {
          "few points",           "Newton on the projections of all points, in place", make<FewPointsSolver>,
          FewPointsSolver::takes, "at most four points with a given approach",         "Tolerance"};
    }

    ContactSolverEntry newton()
    {
      return {"semi-smooth newton",
              "Newton on the projections, active points only",
              make<NewtonSolver>,
              nullptr,
              "",
              "Tolerance, Force change, Max Newton iterations"};
    }

    ContactSolverEntry fixed_point()
    {
      return {"fixed point",
              "the paper's fixed point on the forces with constant rho",
              make<FixedPointSolver>,
              nullptr,
              "",
              "Tolerance, Force change, Max fixed point iterations"};
    }

    ContactSolverEntry automatic()
    {
      ContactSolverEntry row = newton();
      row.name = "automatic";
      row.help = "the first of active set, projected jacobi, few points and semi-smooth newton that takes "
                 "the problem";
      // of fewer points the kept inverse over the closed ones takes less time
      row.points_by_products = 128;
      row.create = [](const ContactSolverParameters &parameters) -> std::unique_ptr<ContactSolver>
      {
        return std::make_unique<FirstThatTakes>(
            ContactSolvers{active_set(), projected_jacobi(), few_points(), newton()}, parameters);
      };
      return row;
    }
  } // namespace

  const ContactSolvers &contact_solvers()
  {
    static const ContactSolvers table = {automatic(),  active_set(), projected_jacobi(),
                                         few_points(), newton(),     fixed_point()};
    return table;
  }

  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters)
  {
    const ContactSolverEntry &row = find_named(*parameters.methods, parameters.method, "contact solver");
    if (row.takes)
      return std::make_unique<FirstThatTakes>(ContactSolvers{row}, parameters);
    return row.create(parameters);
  }
} // namespace vibrocontact
