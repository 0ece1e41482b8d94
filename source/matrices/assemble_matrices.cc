#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/local_file.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/petsc_check.h>
#include <vibrocontact/matrices/check_matrices.h>
#include <vibrocontact/matrices/dmig.h>
#include <vibrocontact/matrices/matrix_market.h>
#include <vibrocontact/matrices/matrix_motions.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/matrices.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Matrix = PETScWrappers::MPI::SparseMatrix;
    using Vector = PETScWrappers::MPI::Vector;
    using Triangle = std::vector<StoredEntry>;

    /// The files' matrices in SI, lower triangles, over the coordinates.
    struct LoadedMatrices
    {
      /// of the coordinates, or with a recovery matrix of its rows
      std::vector<MatrixDof> dofs;
      unsigned int n = 0;
      Triangle stiffness, mass, damping, structural_damping;
      /// T and the motions of translations; empty: none
      DenseMatrix recovery, translations;
    };

    /// One after the other, K first, which says how many coordinates there are.
    class Loader
    {
    public:
      explicit Loader(const MatricesParameters &parameters) : parameters(parameters)
      {
        loaded.dofs = parameters.tables().dofs;
        if (!parameters.recovery.empty())
          loaded.recovery =
              read_dense_matrix_market(parameters.recovery, local_file(parameters.recovery, "Recovery"));
      }

      LoadedMatrices load()
      {
        const std::string *const files[] = {&parameters.stiffness, &parameters.mass, &parameters.damping,
                                            &parameters.structural_damping};
        Triangle *const triangles[] = {&loaded.stiffness, &loaded.mass, &loaded.damping,
                                       &loaded.structural_damping};
        const char *const entries[] = {"Stiffness", "Mass", "Damping", "Structural damping"};
        find_dmig(files);
        check_rows();
        for (unsigned int k = 0; k < 4; ++k)
          if (!files[k]->empty())
          {
            StoredMatrix matrix = read(*files[k], entries[k], k);
            if (matrix.n_rows != loaded.n || matrix.n_columns != loaded.n)
              throw InputError(matrix.source + " holds a matrix of " + std::to_string(matrix.n_rows) +
                               " by " + std::to_string(matrix.n_columns) + ", but there are " +
                               std::to_string(loaded.n) + " " +
                               (parameters.recovery.empty() ? "dofs" : "columns of the recovery matrix") +
                               ": the files belong to different models.");
            *triangles[k] = lower_triangle(std::move(matrix));
          }
        scale();
        return std::move(loaded);
      }

    private:
      /// Reads the files of DMIG and, if no table says so, what the dofs are.
      void find_dmig(const std::string *const (&files)[4])
      {
        std::vector<const DmigMatrix *> taken;
        for (unsigned int k = 0; k < 4; ++k)
          if (is_dmig(*files[k]))
          {
            if (dmig.count(*files[k]) == 0)
              dmig[*files[k]] = read_dmig(*files[k], local_file(*files[k], "Matrices"));
            taken.push_back(&one_of(*files[k], k));
          }
        if (!loaded.dofs.empty())
          return;
        loaded.dofs = dofs_of(taken);
        for (const MatrixDof &dof : loaded.dofs)
          if (dof.direction != MatrixDof::modal && parameters.tables().places.count(dof.node) == 0)
            throw InputError(parameters.nodes + " does not say where node " + std::to_string(dof.node) +
                             " is, which has a dof in " + parameters.stiffness + ": add its place.");
      }

      const DmigMatrix &one_of(const std::string &file, const unsigned int k) const
      {
        const auto &all = dmig.at(file);
        if (all.size() == 1)
          return all.begin()->second;
        const auto found = all.find(parameters.matrix_names.at(k));
        if (found != all.end())
          return found->second;
        std::string names;
        for (const auto &[name, matrix] : all)
          names += (names.empty() ? "" : ", ") + name;
        throw InputError(file + " has no matrix " + parameters.matrix_names.at(k) + " but " + names +
                         ": say by Matrix names which is which.");
      }

      void check_rows()
      {
        loaded.n = loaded.dofs.size();
        if (parameters.recovery.empty())
          return;
        if (loaded.recovery.m() != loaded.dofs.size())
          throw InputError(parameters.recovery + " has " + std::to_string(loaded.recovery.m()) +
                           " rows, but the table of dofs " + std::to_string(loaded.dofs.size()) +
                           ": one line for each row of the recovery matrix is due.");
        loaded.n = loaded.recovery.n();
        if (parameters.translations.empty())
          return;
        loaded.translations = read_dense_matrix_market(parameters.translations,
                                                       local_file(parameters.translations, "Translations"));
        if (loaded.translations.m() != loaded.n || loaded.translations.n() != 3)
          throw InputError(parameters.translations + " holds a matrix of " +
                           std::to_string(loaded.translations.m()) + " by " +
                           std::to_string(loaded.translations.n()) + ", but " + std::to_string(loaded.n) +
                           " by 3 is due: a row for each coordinate, a column for each direction.");
      }

      StoredMatrix read(const std::string &file, const std::string &entry, const unsigned int k) const
      {
        if (is_dmig(file))
          return stored(one_of(file, k), loaded.dofs);
        const std::string bytes = local_file(file, entry);
        return has_extension(file, ".mtx") ? read_matrix_market(file, bytes)
                                           : read_calculix_matrix(file, bytes, loaded.n);
      }

      /// To SI: u of a translation is a length, rotations and modal coordinates stay as they are; energies follow.
      void scale()
      {
        const double length = parameters.length_unit, mass = parameters.mass_unit,
                     time = parameters.time_unit;
        std::vector<double> unit(loaded.n, 1.);
        for (unsigned int i = 0; i < loaded.dofs.size(); ++i)
          if (loaded.dofs[i].direction < 3)
          {
            if (parameters.recovery.empty())
              unit[i] = length;
            else
              for (unsigned int j = 0; j < loaded.n; ++j)
                loaded.recovery(i, j) *= length;
          }
        const auto apply = [&](Triangle &triangle, const double factor)
        {
          for (StoredEntry &entry : triangle)
            entry.value *= factor / (unit[entry.row] * unit[entry.column]);
        };
        const double energy = mass * length * length;
        apply(loaded.mass, energy);
        apply(loaded.damping, energy / time);
        apply(loaded.stiffness, energy / (time * time));
        apply(loaded.structural_damping, energy / (time * time));
        // of a unit of SI
        for (unsigned int j = 0; j < loaded.translations.n(); ++j)
          for (unsigned int i = 0; i < loaded.translations.m(); ++i)
            loaded.translations(i, j) /= length;
      }

      const MatricesParameters &parameters;
      std::map<std::string, std::map<std::string, DmigMatrix>> dmig;
      LoadedMatrices loaded;
    };

    /// Which coordinates are held. @throws InputError for a group that holds nothing
    std::vector<bool> held_dofs(const MatricesParameters &parameters, const LoadedMatrices &loaded)
    {
      std::vector<bool> held(loaded.n, false);
      for (const std::string &name : parameters.held_groups)
      {
        const std::vector<unsigned long> &nodes = parameters.group(name, "Held groups");
        const std::set<unsigned long> members(nodes.begin(), nodes.end());
        bool any = false;
        for (unsigned int i = 0; i < loaded.dofs.size(); ++i)
          if (loaded.dofs[i].direction != MatrixDof::modal && members.count(loaded.dofs[i].node) > 0)
            any = held[i] = true;
        if (!any)
          throw InputError("Held groups names '" + name +
                           "', none of whose nodes has a dof in the matrices: they hold it already; leave it "
                           "out.");
      }
      return held;
    }

    /// A matrix on the places of some triangles, with the values of the first: held dofs keep the diagonal entry or nothing.
    void fill(Matrix &matrix, const SecondOrderSystem &system, const std::vector<const Triangle *> &places,
              const std::vector<bool> &held, const bool keeps_diagonal)
    {
      const unsigned int n = held.size();
      DynamicSparsityPattern pattern(n);
      for (unsigned int i = 0; i < n; ++i)
        pattern.add(i, i);
      const auto for_entries = [&](const Triangle &triangle, const auto &take)
      {
        for (const StoredEntry &entry : triangle)
          if (entry.row == entry.column ? keeps_diagonal || !held[entry.row]
                                        : entry.value != 0 && !held[entry.row] && !held[entry.column])
            take(entry);
      };
      for (const Triangle *const triangle : places)
        for_entries(*triangle,
                    [&](const StoredEntry &entry)
                    {
                      pattern.add(entry.row, entry.column);
                      pattern.add(entry.column, entry.row);
                    });
      matrix.reinit(system.locally_owned, system.locally_owned, pattern, system.communicator);
      for_entries(*places[0],
                  [&](const StoredEntry &entry)
                  {
                    if (system.locally_owned.is_element(entry.row))
                      matrix.add(entry.row, entry.column, entry.value);
                    if (entry.row != entry.column && system.locally_owned.is_element(entry.column))
                      matrix.add(entry.column, entry.row, entry.value);
                  });
      matrix.compress(VectorOperation::add);
    }

    /// How the dofs of nodes move with the coordinates.
    class NodeRows
    {
    public:
      NodeRows(const LoadedMatrices &loaded, const std::vector<bool> &held) : loaded(loaded), held(held)
      {
        for (unsigned int i = 0; i < loaded.dofs.size(); ++i)
          numbers[loaded.dofs[i]] = i;
      }

      /// empty: it does not move
      TraceRow row(const unsigned long node, const unsigned int direction) const
      {
        const auto found = numbers.find({node, direction});
        if (found == numbers.end())
          return {};
        if (loaded.recovery.empty())
          return held[found->second] ? TraceRow() : TraceRow{{found->second, 1.}};
        TraceRow result;
        for (unsigned int j = 0; j < loaded.n; ++j)
          if (loaded.recovery(found->second, j) != 0)
            result.emplace_back(j, loaded.recovery(found->second, j));
        return result;
      }

    private:
      const LoadedMatrices &loaded;
      const std::vector<bool> &held;
      std::map<MatrixDof, unsigned int> numbers;
    };

    /// @throws InputError if all other nodes lie where the opposite body is
    void check_side(const MatricesParameters &parameters, const std::string &name, const NodeGrid &touching,
                    const bool above)
    {
      const std::set<unsigned long> members(touching.nodes.begin(), touching.nodes.end());
      const auto [lowest, highest] = std::minmax_element(touching.height.begin(), touching.height.end());
      unsigned int n_own_side = 0, n_other_side = 0;
      for (const auto &[node, place] : parameters.tables().places)
        if (members.count(node) == 0)
        {
          n_own_side += above ? place[2] > *highest : place[2] < *lowest;
          n_other_side += above ? place[2] < *lowest : place[2] > *highest;
        }
      if (n_own_side == 0 && n_other_side > 0)
        throw InputError(name + "/Matrices/Contact group: " + name + " is the " +
                         (above ? "upper" : "lower") +
                         " body of its contact, but all of its other nodes lie " +
                         (above ? "below" : "above") + " '" + parameters.contact_group +
                         "': name the group on its other side, or exchange the bodies of the contact.");
    }

    ContactTrace contact_trace(const MatricesParameters &parameters, const std::string &name,
                               const NodeRows &rows, const ContactGrid &grid, const bool above)
    {
      if (parameters.contact_group.empty())
        throw InputError(name +
                         "/Matrices/Contact group is empty, but the body is in contact: name the group of "
                         "the nodes that can touch.");
      const NodeGrid nodes =
          node_grid(parameters.contact_group, parameters.group(parameters.contact_group, "Contact group"),
                    parameters.tables().places, grid.spacing_x);
      AssertThrow(nodes.grid.n_points() == grid.n_points(),
                  ExcMessage("the contact has points of another body"));
      const unsigned int n = grid.n_points();
      ContactTrace trace;
      trace.grid = grid;
      trace.rows.resize(3 * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int d = 0; d < 3; ++d)
        {
          TraceRow row = rows.row(nodes.nodes[i], d);
          if (row.empty() && d == 2)
            throw InputError(name + "/Matrices/Contact group: node " + std::to_string(nodes.nodes[i]) +
                             " of '" + parameters.contact_group +
                             "' does not move along z, the normal of the contact: leave it out, or free it.");
          trace.rows[contact_row(n, (d + 1) % 3, i)] = std::move(row);
        }
      check_side(parameters, name, nodes, above);
      trace.surface_height = nodes.height;
      trace.faces_up = !above;
      return trace;
    }

    /// The box around all nodes, by which a wrong unit of length is seen.
    std::string extent_text(const std::map<unsigned long, Point<3>> &places)
    {
      if (places.empty())
        return "no places";
      std::vector<Point<3>> points;
      for (const auto &[node, place] : places)
        points.push_back(place);
      const BoundingBox<3> box(points);
      return "nodes in a box of " + number_text(box.side_length(0)) + " x " +
             number_text(box.side_length(1)) + " x " + number_text(box.side_length(2)) + " m";
    }

    /// Nodes as points without faces between them: those of groups, and all if they are not too many.
    SurfaceTrace nodes_as_surface(const MatricesParameters &parameters, const NodeRows &rows)
    {
      constexpr std::size_t most_nodes = 20000;
      const MatricesParameters::Tables &tables = parameters.tables();
      std::set<unsigned long> shown;
      for (const auto &[name, members] : tables.groups)
        shown.insert(members.begin(), members.end());
      if (tables.places.size() <= most_nodes)
        for (const auto &[node, place] : tables.places)
          shown.insert(node);
      SurfaceTrace surface;
      for (const unsigned long node : shown)
      {
        const auto place = tables.places.find(node);
        TraceRow own[3];
        for (unsigned int d = 0; d < 3; ++d)
          own[d] = rows.row(node, d);
        if (place == tables.places.end() || (own[0].empty() && own[1].empty() && own[2].empty()))
          continue;
        const int number = surface.points.size();
        surface.points.push_back(place->second);
        surface.rows.insert(surface.rows.end(), std::begin(own), std::end(own));
        surface.quads.push_back({{number, number, number, number}});
      }
      return surface;
    }
  } // namespace

  std::unique_ptr<SecondOrderSystem> MatricesParameters::assemble(const BodyParameters &body,
                                                                  const bool above,
                                                                  const ContactGrid *const grid,
                                                                  const MPI_Comm communicator) const
  {
    LoadedMatrices loaded = Loader(*this).load();
    const std::vector<bool> held = held_dofs(*this, loaded);
    const unsigned int n = loaded.n, n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n < n_ranks)
      throw InputError("Body " + body.name + " has " + std::to_string(n) + " dofs, less than the " +
                       std::to_string(n_ranks) + " ranks: start fewer.");
    auto system = std::make_unique<SecondOrderSystem>();
    system->body = body.name;
    system->communicator = communicator;
    system->locally_owned = Utilities::create_evenly_distributed_partitioning(
        Utilities::MPI::this_mpi_process(communicator), n_ranks, n);

    check_diagonals(loaded.stiffness, stiffness, n,
                    loaded.recovery.empty() ? loaded.dofs : std::vector<MatrixDof>());
    check_diagonals(loaded.mass, mass, n, {});
    fill(system->stiffness, *system,
         {&loaded.stiffness, &loaded.mass, &loaded.damping, &loaded.structural_damping}, held, true);
    fill(system->mass, *system, {&loaded.mass}, held, false);
    check_semidefinite(system->stiffness, *system, stiffness, "stiffness");
    check_semidefinite(system->mass, *system, mass, "mass");
    check_diagonals(loaded.structural_damping, structural_damping, n, {});
    system->has_damping = !damping.empty();
    if (system->has_damping)
      fill(system->damping, *system, {&loaded.damping}, held, false);
    system->has_loss = !structural_damping.empty();
    if (system->has_loss)
    {
      fill(system->loss_stiffness, *system, {&loaded.structural_damping}, held, false);
      check_semidefinite(system->loss_stiffness, *system, structural_damping, "structural damping");
    }

    const bool all_placed =
        loaded.recovery.empty() &&
        std::none_of(loaded.dofs.begin(), loaded.dofs.end(),
                     [](const MatrixDof &dof) { return dof.direction == MatrixDof::modal; });
    double size = 1e-300;
    for (const auto &[node, place] : tables().places)
      size = std::max(size, place.norm());
    for (const auto i : system->locally_owned)
    {
      const bool placed = loaded.recovery.empty() && loaded.dofs[i].direction != MatrixDof::modal;
      // coordinates without a place stand on a line of their own: what orders modes wants them apart
      system->dof_position.push_back(placed ? tables().places.at(loaded.dofs[i].node)
                                            : Point<3>(0, size * (i + 1.) / n, 0));
      system->dof_direction.push_back(placed ? loaded.dofs[i].direction : 6);
    }
    system->rigid_motions = all_placed ? rigid_motions_by_places(*system, held, size) : null_motions(*system);
    system->n_rigid_modes = system->rigid_motions.size();
    run_log().line(body.name + ": " + std::to_string(n) + " coordinates, " +
                   std::to_string(system->n_rigid_modes) + " rigid motions, " + extent_text(tables().places));
    for (unsigned int d = 0; d < loaded.translations.n(); ++d)
    {
      system->translations.emplace_back(system->locally_owned, communicator);
      for (const auto i : system->locally_owned)
        system->translations.back()(i) = loaded.translations(i, d);
      system->translations.back().compress(VectorOperation::insert);
    }
    system->total_mass = mass_along_axes(*system);
    if (system->total_mass > 0)
      run_log().line(body.name + ": a mass of " + number_text(system->total_mass) + " kg");
    system->follows_hub = system->n_rigid_modes == 0;
    const NodeRows rows(loaded, held);
    system->surface = nodes_as_surface(*this, rows);
    if (grid)
      system->trace = contact_trace(*this, body.name, rows, *grid, above);
    return system;
  }
} // namespace vibrocontact
