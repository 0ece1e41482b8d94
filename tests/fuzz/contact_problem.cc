#include "hdf5_bytes.h"
#include "readers.h"

#include <vibrocontact/contact/problem_file.h>

using namespace vibrocontact;

namespace
{
  std::string good_problem()
  {
    ContactProblem problem;
    DenseMatrix A(6);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        A(i, j) = i == j ? 2e-9 : 1e-10;
    problem.A = std::make_shared<DenseContactOperator>(std::move(A));
    problem.b.reinit(6);
    problem.mu = {0.3, 0.3};
    problem.normal_force = 100;
    problem.title = "two points";
    ContactSolution solution;
    solution.R.reinit(6);
    solution.y.reinit(6);
    solution.R[0] = solution.R[1] = 50;
    write_contact_problem("problem.h5", problem, solution);
    return readers::content_of("problem.h5");
  }
} // namespace

void readers::contact_problem(const std::string &bytes)
{
  static const std::string good = good_problem();
  const std::string file = file_of("problem.h5", hdf5_bytes(bytes, good, false));
  ContactProblem problem;
  if (taken([&] { problem = read_contact_problem(file); }))
    taken([&] { read_contact_solution(file, problem); });
}
