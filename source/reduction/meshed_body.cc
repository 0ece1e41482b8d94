#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/meshed_body.h>

#include <boost/crc.hpp>

#include <fstream>
#include <iterator>
#include <sstream>

namespace vibrocontact
{
  std::string body_key(const DeclaredParameters &parameters, const std::string &body,
                       const double lateral_position, const ContactGrid *const grid)
  {
    std::ostringstream key;
    key.precision(17);
    for (const DeclaredParameters::Entry &entry : parameters.entries)
    {
      const bool own = entry.section == body || entry.section.rfind(body + "/", 0) == 0;
      if (!own || entry.section == body + "/Modes")
        continue;
      key << entry.section.substr(body.size()) << "/" << entry.name << "=" << entry.value << "\n";
      std::ifstream file(entry.value, std::ios::binary);
      if (entry.value.empty() || !file)
        continue;
      const std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      boost::crc_32_type checksum;
      checksum.process_bytes(content.data(), content.size());
      key << "contents: " << content.size() << " bytes, crc " << checksum.checksum() << "\n";
    }
    if (grid)
      key << "lateral position=" << lateral_position << "\ngrid=" << grid->n_x << " x " << grid->n_y
          << " from " << grid->x_first << ", " << grid->y_first << " by " << grid->spacing_x << ", "
          << grid->spacing_y << ", traction " << int(grid->traction) << "\n";
    return key.str();
  }

  MeshedBody::MeshedBody(const BodyParameters &parameters, const ModeParameters &modes,
                         const double lateral_position, const ContactGrid *const grid, const std::string &key,
                         const ReductionCache &cache, const MPI_Comm communicator)
      : parameters(parameters), mode_parameters(modes), lateral_position(lateral_position), grid(grid),
        key(key), cache(cache), communicator(communicator)
  {
  }

  const ElasticBody<3> &MeshedBody::elastic_body()
  {
    if (!body)
    {
      run_log().block("Mesh of " + parameters.name);
      body = make_elastic_body(parameters, lateral_position, grid, communicator);
      run_log().value("cells", static_cast<unsigned int>(body->mesh.triangulation->n_global_active_cells()));
      run_log().value("dofs", static_cast<unsigned int>(body->dof_handler.n_dofs()));
    }
    return *body;
  }

  const SecondOrderSystem &MeshedBody::system()
  {
    if (!matrices)
    {
      elastic_body();
      run_log().block("Matrices of " + parameters.name);
      matrices = body->assemble(grid);
      matrices->body = parameters.name;
      run_log().value("mass", matrices->total_mass, "kg");
    }
    return *matrices;
  }

  Flexibility &MeshedBody::flexibility()
  {
    if (!inverse)
    {
      system();
      run_log().block("Factorisation of " + parameters.name);
      inverse = std::make_unique<Flexibility>(*matrices);
      const auto &statistics = inverse->factorization().statistics();
      run_log().value("memory on the fullest rank", statistics.megabytes_rank, "MB");
      run_log().value("entries of the factors", statistics.factor_entries);
    }
    return *inverse;
  }

  const StaticReduction &MeshedBody::statics()
  {
    if (!static_part)
      static_part = cache.load_static(parameters.name, key);
    if (!static_part)
    {
      flexibility();
      run_log().block("Contact compliance of " + parameters.name);
      static_part = reduce_statically(*matrices, *inverse);
      cache.save(key, *static_part);
    }
    return *static_part;
  }

  const ModalReduction &MeshedBody::modes()
  {
    const std::string modal_key = key + mode_parameters.key();
    if (!modal_part)
      modal_part = cache.load_modal(parameters.name, modal_key);
    if (!modal_part)
    {
      flexibility();
      run_log().block("Modes of " + parameters.name);
      std::optional<WheelFrame> wheel;
      if (parameters.type == "wheel")
      {
        wheel.emplace();
        wheel->axle_height = tread_radius(wheel_outline(parameters.wheel), lateral_position);
        wheel->rim_radius = mode_parameters.rim_radius;
      }
      modal_part = reduce_modally(*matrices, *inverse, mode_parameters, wheel);
      cache.save(parameters.name, modal_key, *modal_part);
    }
    return *modal_part;
  }

  dealii::PETScWrappers::MPI::Vector MeshedBody::displacement(const std::vector<double> &R)
  {
    Flexibility &G = flexibility();
    dealii::PETScWrappers::MPI::Vector force(matrices->locally_owned, communicator),
        u(matrices->locally_owned, communicator);
    for (unsigned int row = 0; row < R.size(); ++row)
      if (R[row] != 0)
        for (const auto &[dof, weight] : matrices->trace.rows[row])
          if (matrices->locally_owned.is_element(dof))
            force(dof) += weight * R[row];
    force.compress(dealii::VectorOperation::add);
    if (matrices->has_load)
      force += matrices->load;
    G.vmult(u, force);
    return u;
  }
} // namespace vibrocontact
