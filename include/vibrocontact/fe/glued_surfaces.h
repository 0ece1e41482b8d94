#pragma once

#include <vibrocontact/fe/face_overlap.h>

#include <deal.II/base/types.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A face with the unknowns of its nodes.
  struct FaceOfDofs
  {
    SurfaceFace face;
    /// of each node, along x, y, z
    std::vector<std::array<dealii::types::global_dof_index, 3>> dofs;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &face &dofs;
    }
  };

  /// Couplings of a follower's faces with a leader's, the same for all directions; nodes are called by their unknown along x.
  struct MortarMatrices
  {
    using Dof = dealii::types::global_dof_index;
    struct Node
    {
      dealii::Point<3> place;
      std::array<Dof, 3> dofs;
      /// diagonal of D [m^2]
      double area = 0;
      /// row of M by the leader's nodes [m^2]
      std::map<Dof, double> leaders;
      /// ends of the edge whose middle it is, where shape functions are transformed; else none
      std::vector<Dof> corners;
      /// followers on its faces
      std::vector<Dof> neighbours;
    };
    std::map<Dof, Node> followers;
    /// places and unknowns of the leader's nodes
    std::map<Dof, std::pair<dealii::Point<3>, std::array<Dof, 3>>> leaders;
    /// largest distance between the two, and what of the follower is uncovered, over its area
    double gap = 0, uncovered = 0;
    /// in the transformation of quadratic triangles
    static constexpr double alpha = 0.2;
  };

  /// Integrates D and M over the parts that faces share.
  /// @param what the pair and where it stands, for messages @throws InputError see glue_faces()
  MortarMatrices mortar_matrices(const std::vector<FaceOfDofs> &followers,
                                 const std::vector<FaceOfDofs> &leaders, const std::string &entry,
                                 const std::string &follower_name, const std::string &leader_name);
} // namespace vibrocontact
