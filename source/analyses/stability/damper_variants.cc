#include <vibrocontact/analyses/stability/damper_variants.h>
#include <vibrocontact/base/failure.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    std::shared_ptr<AnswerOfRest> answer(const ContactPair &pair, const HystereticLoss &loss,
                                         const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                         const bool exact)
    {
      std::vector<PatchReceptance> further;
      for (const ExactReceptance &body : loss.exact)
        further.push_back({body.basis, exact ? body.at : body.by_poles, {}});
      return std::make_shared<AnswerOfRest>(
          std::make_shared<const ContactReceptance>(pair, scheme, equilibrium, &loss, further));
    }
  } // namespace

  DamperVariants::DamperVariants(const ContactPair &pair, const HystereticLoss &loss,
                                 const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                 std::shared_ptr<const RevolvedShapes> section)
      : section(std::move(section)), rest(answer(pair, loss, scheme, equilibrium, true))
  {
    nearly = loss.exact.empty() ? rest : answer(pair, loss, scheme, equilibrium, false);
    const unsigned int m = std::count(pair.body.begin(), pair.body.end(), 1u), n_rows = pair.trace.m();
    DenseMatrix trace(n_rows, m);
    bare.loss.reinit(m, m);
    for (unsigned int k = 0; k < m; ++k)
    {
      bare.omega.push_back(pair.omega[k]);
      bare.labels.push_back(pair.labels[k]);
      for (unsigned int i = 0; i < n_rows; ++i)
        trace(i, k) = pair.trace(i, k);
      for (unsigned int i = 0; i < m; ++i)
        bare.loss(i, k) = loss.modal(i, k);
    }
    bare.amplitudes.reinit(rest->basis().n(), m);
    rest->basis().Tmmult(bare.amplitudes, trace);
  }

  std::pair<BareBody, std::vector<AttachedMass>> DamperVariants::damped(const BodyParameters &body) const
  {
    const std::vector<WheelDamper> *const dampers = body.description->wheel_dampers();
    if (!dampers || dampers->empty())
      return {bare, {}};
    const std::string path = body.name + "/" + body.body_type().section + "/Damper";
    BareBody with_layers = bare;
    with_layers.loss.add(1., loss_of_parts(*section, loss_of_layers(*section, *dampers, path)));
    return {std::move(with_layers), attached_masses(*section, *dampers, path)};
  }

  std::vector<StabilityRoot> DamperVariants::roots(const BodyParameters &body)
  {
    const auto [with_layers, attached] = damped(body);
    std::vector<StabilityRoot> roots = roots_of_body(*nearly, *rest, with_layers, attached);
    for (StabilityRoot &root : roots)
      root.exact = nearly != rest;
    return roots;
  }

  void DamperVariants::prepare(const std::vector<const BodyParameters *> &bodies, const MPI_Comm communicator)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator),
                       rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::vector<double> own, all;
    for (unsigned int k = rank; k < bodies.size(); k += n_ranks)
    {
      // a variant that comes to nothing says so when it is computed
      const Failure ignored = failure_of(
          [&]
          {
            const auto [with_layers, attached] = damped(*bodies[k]);
            for (const StabilityRoot &root : roots_of_body(*nearly, *nearly, with_layers, attached))
              own.push_back(2 * dealii::numbers::PI * root.frequency);
          });
    }
    for (const std::vector<double> &some : dealii::Utilities::MPI::all_gather(communicator, own))
      all.insert(all.end(), some.begin(), some.end());
    rest->make_pieces(all, communicator);
  }
} // namespace vibrocontact
