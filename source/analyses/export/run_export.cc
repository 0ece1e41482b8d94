#include <vibrocontact/analyses/export/body_matrices.h>
#include <vibrocontact/analyses/export/run_export.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/run/check_export.h>
#include <vibrocontact/run/entries_of_bodies.h>
#include <vibrocontact/run/entries_of_contact.h>

namespace vibrocontact
{
  void ExportParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Form", form,
        "What is written of every reduced body: matrices (Matrix Market with tables, and HDF5), which "
        "Type = matrices reads, state space (A, B, C, D for numpy and Octave), or both. Units: none.",
        dealii::Patterns::Selection("matrices|state space|both"));
  }

  namespace
  {
    void export_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.contact = use.motion = use.loss = use.scaled_damping = true;
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
        if (parameters.scene.bodies[k].is_meshed())
          add_body(entries, parameters, k, use);
      add_contact_grid(entries, parameters);
    }

    void run_export(const AnalysisRun &on)
    {
      const auto &own =
          dynamic_cast<const ExportParameters &>(*on.parameters.scene.own_parameters.at("export"));
      run_log().block("Export");
      for (const auto &body : on.bodies)
      {
        if (!body || !is_exported(on.parameters, body->parameters))
          continue;
        const std::string &name = body->parameters.name;
        ReducedBody reduced = body->reduction.reduced(true);
        complete_reduction(reduced, body->parameters, body->reduction.request().modes);
        if (body->reduction.system().has_damping && reduced.loss.m() > 0)
          throw InputError(name + " has a viscous damping and a structural one that couples modes, which its "
                                  "reduced matrices do not keep apart: leave one of them out.");
        const BodyMatrices matrices = body_matrices(reduced);
        nlohmann::ordered_json json = {{"n_modes", matrices.n_modes},
                                       {"n_rigid_modes", matrices.n_rigid_modes},
                                       {"n_coordinates", matrices.mass.m()},
                                       {"contact_points", matrices.points.size()}};
        const std::string stem = "export/" + name;
        on_first_rank(
            [&]
            {
              if (own.form != "state space")
              {
                write_matrices(matrices, on.folder + "/" + stem);
                write_matrices_hdf5(matrices, on.folder + "/" + stem + "/matrices.h5");
              }
              if (own.form != "matrices")
                write_state_space(matrices, on.folder + "/" + stem + "/state_space.h5");
            });
        if (own.form != "state space")
          json["matrices"] = stem;
        if (own.form != "matrices")
        {
          json["state_space"] = stem + "/state_space.h5";
          if (matrices.structural_damping.m() > 0)
            run_log().line("The loss of " + name + " couples modes, which a state space leaves out.");
        }
        run_log().value(name, std::to_string(matrices.n_modes) + " modes, " +
                                  std::to_string(matrices.mass.m() - matrices.n_modes) +
                                  " coordinates of residual flexibility, " +
                                  std::to_string(matrices.points.size()) + " contact points: " + stem);
        on.results.analyses["export"][name] = json;
        on.save();
      }
    }

    std::vector<std::string> export_answer(const nlohmann::ordered_json &bodies)
    {
      using namespace answer_parts;
      std::vector<std::string> lines;
      for (const auto &[name, body] : bodies.items())
        lines.push_back(name + ": " + number_text(number(body, "n_modes")) + " modes at " +
                        number_text(number(body, "contact_points")) + " contact points");
      return lines;
    }
  } // namespace

  Analysis export_analysis()
  {
    Analysis row;
    row.type = {"export", "matrices and state space of the reduced bodies, for other programs", 1, false,
                true};
    row.type.section = "Export";
    row.type.make_parameters = [] { return std::make_shared<ExportParameters>(); };
    row.reads = export_read;
    row.run = run_export;
    row.continues = false;
    row.answers = {{"export", "export", export_answer, {"export/*"}}};
    return row;
  }
} // namespace vibrocontact
