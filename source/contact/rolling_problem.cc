#include <vibrocontact/contact/rolling_problem.h>

namespace vibrocontact
{
  namespace
  {
    ContactProblem with_operator(std::shared_ptr<const ContactOperator> A, const ContactGrid &grid,
                                 const Creepage &creepage, const std::vector<double> &gap,
                                 const double friction)
    {
      ContactProblem problem;
      problem.A = std::move(A);
      problem.b = rigid_slip(grid, creepage);
      std::copy(gap.begin(), gap.end(), problem.b.begin());
      problem.mu.assign(grid.n_points(), friction);
      return problem;
    }
  } // namespace

  ContactProblem half_space_rolling_problem(const ContactGrid &grid, const HalfSpacePair &pair,
                                            const CreepScheme &scheme, const Creepage &creepage,
                                            const std::vector<double> &gap, const double friction)
  {
    return with_operator(std::make_shared<HalfSpaceRollingOperator>(grid, pair, scheme, creepage.speed), grid,
                         creepage, gap, friction);
  }

  ContactProblem rolling_problem(const ContactGrid &grid, DenseMatrix compliance, const CreepScheme &scheme,
                                 const Creepage &creepage, const std::vector<double> &gap,
                                 const double friction)
  {
    convert_to_slip_rows(grid, scheme, creepage.speed, compliance);
    return with_operator(std::make_shared<DenseContactOperator>(std::move(compliance)), grid, creepage, gap,
                         friction);
  }
} // namespace vibrocontact
