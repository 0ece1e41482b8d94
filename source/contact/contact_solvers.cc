#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>

namespace vibrocontact
{
  const ContactSolvers &contact_solvers()
  {
    static const ContactSolvers table = {
        {"semi-smooth newton", "Newton on the projections, active points only",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<NewtonSolver>(p); }},
        {"fixed point", "the paper's fixed point on the forces with constant rho",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<FixedPointSolver>(p); }}};
    return table;
  }

  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters)
  {
    return find_named(*parameters.methods, parameters.method, "contact solver").create(parameters);
  }
} // namespace vibrocontact
