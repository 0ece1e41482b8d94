#pragma once

#include <deal.II/base/point.h>

#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  using NodePlaces = std::map<unsigned long, dealii::Point<3>>;
  using NodeGroups = std::map<std::string, std::vector<unsigned long>>;

  /// What one dof of a matrix is.
  struct MatrixDof
  {
    /// of a coordinate that is no displacement of a node (a modal coordinate)
    static constexpr unsigned int modal = 6;

    unsigned long node;
    /// 0 to 2 along x, y, z, 3 to 5 about them, or modal
    unsigned int direction;

    bool operator<(const MatrixDof &other) const
    {
      return node != other.node ? node < other.node : direction < other.direction;
    }
    bool operator==(const MatrixDof &other) const
    {
      return node == other.node && direction == other.direction;
    }
    /// "x of node 12"
    std::string text() const;
  };

  /// Where nodes are.
  struct NodeTable
  {
    NodePlaces places;
    /// of columns x_m, y_m, z_m, whatever the unit of the files
    bool in_metres = false;
  };

  /// Dofs in the order of a matrix, and where their nodes are.
  struct MatrixDofs
  {
    std::vector<MatrixDof> dofs;
    NodeTable nodes;
  };

  /// A table of dofs: one line for each row of the matrices.
  ///
  ///     node, x, y, z, direction         direction: x, y, z, rx, ry, rz (rotations about them)
  ///     12, 0.1, 0, 0.02, x              or modal, without a place
  ///
  /// x, y, z are in the unit of the files; x_m, y_m, z_m instead are in metres.
  /// @param source file, for messages @throws InputError with file and line
  MatrixDofs read_dof_table(const std::string &source, const std::string &bytes);
  /// Columns node, x, y, z.
  NodeTable read_node_table(const std::string &source, const std::string &bytes);
  /// Columns group, node.
  NodeGroups read_group_table(const std::string &source, const std::string &bytes);

  /// Dofs that CalculiX stores beside its matrices (`.dof`), a line `12.3` for the third direction of node 12.
  std::vector<MatrixDof> read_calculix_dofs(const std::string &source, const std::string &bytes);

  /// What a deck of CalculiX or Abaqus says of its nodes: lines after *NODE and *NSET (GENERATE as well). Names of sets in
  /// capital letters, as these programs take them.
  struct DeckNodes
  {
    NodePlaces places;
    NodeGroups groups;
  };
  DeckNodes read_deck(const std::string &source, const std::string &bytes);
} // namespace vibrocontact
