#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/matrix_nodes.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Whether a matrix's file is one of Nastran's DMIG cards: its name has none of the other endings.
  bool is_dmig(const std::string &file);

  /// A body by the matrices of another program: M U'' + C U' + (K + i H) U = F, whole or already reduced (doc/matrices.md).
  ///
  /// The coordinates are displacements and rotations of nodes or, of a reduced body, partly modal ones. With a recovery matrix
  /// T all of them are without a place, u = T q, and the table of dofs says what the rows of T are.
  ///
  /// Its contact is a group of nodes on lines along x and y, each node a contact point of its own: gap, slip and force of
  /// the node. The files' axes are those of the contact (z up), its nominal contact point becomes the origin.
  struct MatricesParameters : ElementBody
  {
    /// files: Matrix Market (.mtx), of CalculiX (.sti, .mas) or Nastran's DMIG (any other)
    std::string stiffness, mass, damping, structural_damping;
    /// of DMIG: those of K, M, C, H
    std::vector<std::string> matrix_names = {"KAAX", "MAAX", "BAAX", "K4AAX"};
    /// table of dofs, or .dof of CalculiX; of DMIG empty
    std::string dofs;
    /// places of nodes for .dof and DMIG: .csv, deck of CalculiX (.inp), cards GRID (any other)
    std::string nodes;
    /// table of groups; empty: sets of the deck
    std::string groups;
    /// T, and what the coordinates do where the whole body moves by one along x, y, z (n x 3)
    std::string recovery, translations;
    std::string contact_group;
    /// [unit of the file]
    std::vector<double> contact_point = {0, 0, 0};
    std::vector<std::string> held_groups;
    /// of the files [m], [kg], [s]
    double length_unit = 1, mass_unit = 1, time_unit = 1;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    bool takes_cell() const override;
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                const ContactGrid *grid,
                                                MPI_Comm communicator) const override;
    bool is_assembled_first() const override { return true; }
    bool has_material() const override { return false; }
    bool has_loss() const override { return !damping.empty() || !structural_damping.empty(); }
    bool may_stand_for_half_space() const override { return false; }

    /// What the tables say, in SI and from the contact point; read once.
    struct Tables
    {
      /// empty of DMIG: they follow from the matrices
      std::vector<MatrixDof> dofs;
      NodePlaces places;
      NodeGroups groups;
      /// file that the groups come from; empty: none
      std::string source_of_groups;
    };
    /// @throws InputError with file and line
    const Tables &tables() const;
    /// Nodes of a group. @param entry that names it, for the message @throws InputError that lists the groups there are
    const std::vector<unsigned long> &group(const std::string &name, const std::string &entry) const;

  private:
    mutable std::shared_ptr<const Tables> kept;
    mutable std::string kept_for;
  };

  /// The grid whose points are these nodes, and the node of each point.
  struct NodeGrid
  {
    ContactGrid grid;
    std::vector<unsigned long> nodes;
    /// height of each [m]
    std::vector<double> height;
  };
  /// @param cell width of the cells of a line of nodes or of a single one [m]
  /// @throws InputError for nodes that lie on no lines along x and y at equal distances, or on no flat surface
  NodeGrid node_grid(const std::string &group, const std::vector<unsigned long> &nodes,
                     const NodePlaces &places, double cell);
} // namespace vibrocontact
