#include <vibrocontact/base/log.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/output/scene_summary.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <deal.II/base/mpi.h>

namespace vibrocontact
{
  MeshedBodies meshed_bodies(Parameters &parameters, const DeclaredParameters &declared,
                             const ContactGrid &grid)
  {
    const ContactGrid *const contact_grid = parameters.has_contact() ? &grid : nullptr;
    const double lateral_position = parameters.contact.lateral_position;
    MeshedBodies bodies;
    for (const BodyParameters &body : parameters.scene.bodies)
      bodies.push_back(body.is_meshed() ? std::make_unique<MeshedBody>(
                                              body, parameters.modes[body.name], bodies.empty(),
                                              lateral_position, contact_grid,
                                              body_key(declared, body.name, lateral_position, contact_grid) +
                                                  (bodies.empty() ? "above" : "below"),
                                              parameters.output.cache_directory, MPI_COMM_WORLD)
                                        : nullptr);
    return bodies;
  }

  std::unique_ptr<const PreparedPair> prepare_pair(const Parameters &parameters, const MeshedBodies &bodies,
                                                   const bool with_modes)
  {
    auto pair = std::make_unique<PreparedPair>();
    pair->reduced.resize(2);
    for (unsigned int k = 0; k < 2; ++k)
    {
      if (bodies[k])
        pair->reduced[k] = bodies[k]->reduction.reduced(with_modes);
      pair->bodies.push_back({&parameters.scene.bodies[k], bodies[k] ? &pair->reduced[k] : nullptr});
    }
    return pair;
  }

  void check_meshes(const Parameters &parameters, const MeshedBodies &bodies, const bool all)
  {
    for (const auto &body : bodies)
      if (body)
      {
        const bool with_modes = (parameters.scene.runs("modes") || parameters.has_dynamics()) &&
                                body->reduction.request().modes.any();
        // a mesh that is to be written has to be made
        const bool wanted = all || !body->parameters.wheel.write_mesh.empty();
        if (body->reduction.is_cached(parameters.has_contact(), with_modes) && !wanted)
          continue;
        if (!body->parameters.is_solid())
          continue;
        body->elastic_body();
        body->check_contact();
      }
  }

  void print_scene(const Parameters &parameters, const MeshedBodies &bodies, const ContactGrid &grid)
  {
    const ContactGrid *const contact_grid = parameters.has_contact() ? &grid : nullptr;
    for (unsigned int k = 0; k < bodies.size(); ++k)
      print_body(parameters.scene.bodies[k],
                 bodies[k] && bodies[k]->parameters.is_solid() ? &bodies[k]->elastic_body() : nullptr,
                 contact_grid);
    if (contact_grid)
      print_contact_grid(grid);
    run_log().end_block();
    run_log().line("");
    run_log().line("The file is valid; nothing was run.");
  }

  nlohmann::ordered_json reductions_json(const MeshedBodies &bodies)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    const std::vector<double> memory = peak_memory_of_ranks();
    for (const auto &body : bodies)
      if (body)
      {
        nlohmann::ordered_json stages = nlohmann::ordered_json::object(),
                               ranks = nlohmann::ordered_json::array();
        for (const auto &[stage, seconds] : body->reduction.stages())
          stages[stage] = stages.value(stage, 0.) + seconds;
        const ElasticBody<3> *const made = body->made();
        const auto dofs = dealii::Utilities::MPI::all_gather(
            MPI_COMM_WORLD, made ? static_cast<unsigned long long>(made->locally_owned.n_elements()) : 0ull);
        for (unsigned int r = 0; r < dofs.size() && made; ++r)
          ranks.push_back({{"dofs", dofs[r]}, {"peak_memory_MB", memory[r]}});
        result[body->parameters.name] = {{"stages_s", stages}, {"ranks", ranks}};
      }
    return result;
  }
} // namespace vibrocontact
