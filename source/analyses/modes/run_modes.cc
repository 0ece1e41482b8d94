#include <vibrocontact/analyses/modes/modal.h>
#include <vibrocontact/analyses/modes/modal_output.h>
#include <vibrocontact/analyses/modes/run_modes.h>
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/surface_fields.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <filesystem>

namespace vibrocontact
{
  namespace
  {
    /// Copies a set of n fields; its .pvd, which says that the set is complete, comes last.
    void copy_fields(const std::string &from, const std::string &to, const std::string &set,
                     const unsigned int n)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        const std::string name = field_name(set, k);
        copy_file(from + "/" + name, to + "/" + name);
      }
      copy_file(from + "/" + set + ".pvd", to + "/" + set + ".pvd");
    }

    /// Of a body that is known on its surface alone.
    void write_surface_shapes(MeshedBody &body, const ModalResult &modes, const std::string &folder)
    {
      const SurfaceShapes shapes = shapes_of_modes(body, body.parameters);
      const std::string set = "mode_" + body.parameters.name;
      on_first_rank(
          [&]
          {
            std::vector<std::pair<double, std::string>> files;
            for (unsigned int k = 0; k < shapes.n_modes(); ++k)
            {
              std::vector<double> amplitudes(shapes.n_modes(), 0.);
              amplitudes[k] = 1;
              files.emplace_back(modes.frequencies_Hz[k], field_name(set, k));
              write_surface(shapes.points, shapes.quads,
                            {{"displacement", surface_displacement(shapes, amplitudes)}},
                            folder + "/" + files.back().second);
            }
            write_pvd(files, folder + "/" + set + ".pvd");
          });
    }

    void write_shapes(MeshedBody &body, const ModalResult &modes, const std::string &folder)
    {
      const std::string set = "mode_" + body.parameters.name;
      const unsigned int n = modes.frequencies_Hz.size();
      const std::string modes_file = body.reduction.modes_file();
      const std::string kept = modes_file.empty() ? "" : modes_file + ".shapes";
      if (!body.reduction.has_shapes())
      {
        on_first_rank(
            [&]
            {
              if (std::filesystem::exists(kept + "/" + set + ".pvd"))
                copy_fields(kept, folder, set, n);
              else
                run_log().line(
                    "No shapes: they were not kept when these modes were computed (Output/Fields = false?); "
                    "another Output/Cache directory computes them anew.");
            });
        return;
      }
      std::vector<FieldState> states;
      for (unsigned int k = 0; k < n; ++k)
        states.push_back({&body.reduction.shapes().shapes[k], modes.frequencies_Hz[k]});
      write_surface_fields(body.elastic_body(), states, folder, set);
      if (kept.empty())
        return;
      on_first_rank(
          [&]
          {
            try
            {
              copy_fields(folder, kept, set, n);
            }
            catch (const std::exception &error)
            {
              // like the reductions: a cache that cannot be written is no reason to stop
              run_log().warning("The mode shapes are not kept: " + std::string(error.what()));
            }
          });
    }

    /// Of complex modes, at one moment and a quarter of a period later. They depend on the damping, which is no part of what
    /// is kept.
    void write_complex_shapes(MeshedBody &body, const ModalResult &modes, const std::string &folder)
    {
      const std::vector<dealii::PETScWrappers::MPI::Vector> &real = body.reduction.shapes().shapes;
      for (const bool later : {false, true})
      {
        std::vector<dealii::PETScWrappers::MPI::Vector> shapes;
        for (unsigned int k = 0; k < modes.amplitudes.n(); ++k)
        {
          shapes.emplace_back(real.front());
          shapes.back() = 0;
          // Re of the amplitude times 1 and times i
          for (unsigned int i = 0; i < modes.amplitudes.m(); ++i)
            shapes.back().add(later ? -modes.amplitudes(i, k).imag() : modes.amplitudes(i, k).real(),
                              real[i]);
        }
        std::vector<FieldState> states;
        for (unsigned int k = 0; k < shapes.size(); ++k)
          states.push_back({&shapes[k], modes.frequencies_Hz[k]});
        write_surface_fields(body.elastic_body(), states, folder,
                             "mode_" + body.parameters.name + (later ? "_quarter_period_later" : ""));
      }
    }
  } // namespace

  void run_modes(MeshedBody &body, const bool fields, const std::string &folder, Results &results)
  {
    const std::string &name = body.parameters.name;
    run_log().block("Modes of " + name);
    const bool complex = body.parameters.rotation.has_coriolis();
    // double modes differ from one computation to the next: their amplitudes are those of these shapes
    if (fields && complex)
      body.reduction.shapes();
    const ModalResult modes = modal_analysis(body);
    results.analyses["modes"][name] = modal_json(modes);
    on_first_rank([&] { modal_table(modes).write(folder + "/modes_" + name + ".csv"); });
    if (fields && body.parameters.is_solid())
      complex ? write_complex_shapes(body, modes, folder) : write_shapes(body, modes, folder);
    if (fields && body.parameters.is_revolved())
      write_surface_shapes(body, modes, folder);
  }

  namespace
  {
    void modes_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.motion = use.loss = use.scaled_damping = true;
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
        if (parameters.scene.bodies[k].is_meshed())
          add_body(entries, parameters, k, use);
      add_lateral_position(entries, parameters);
    }

    void run_all_modes(const AnalysisRun &on)
    {
      for (const auto &body : on.bodies)
        if (body && on.parameters.modes.at(body->parameters.name).any())
        {
          run_modes(*body, on.parameters.output.fields, on.folder, on.results);
          on.save();
        }
    }
  } // namespace

  Analysis modes_analysis()
  {
    return {{"modes", "natural frequencies, shapes and damping of every meshed body", 1},
            modes_read,
            run_all_modes,
            false,
            {{"modes", "modes", modes_answer, {"modes_*.csv", "figures/mode_shapes_*.png"}}}};
  }
} // namespace vibrocontact
