#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/scene/contact_grid.h>

#include <array>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Where material enters the contact, the edge of the contact lies anywhere between the first point in contact
  /// (1) and the open one upstream of it (0):
  ///
  ///        ...  o     o  |  x     x     x  ...        o open, x in contact, | the edge
  ///            -1     0     1     2     3             -> x
  ///
  /// The difference (u_1 - u_0) / h knows nothing of it, so that tractions begin by up to half a cell too early or too
  /// late: an error of first order that changes with every alignment of the grid (doc/contact.md, "Creep and grid").
  /// The normal solution knows, by the gap g_0 that is left at the open point. Near the edge tractions are
  /// proportional to the pressure (Carter; Cattaneo and Mindlin), T = k N, and point 0 then slips by
  ///
  ///   delta_0 = k gamma g_0 = gamma g_0 T_1 / N_1
  ///
  /// before it is at 1, gamma: tangential over normal compliance of a line load (1 along x, 1 / (1 - nu) along y for equal
  /// materials). Hence s_1 = V [xi + (u_1 - u_0 + delta_0) / h]: a compliance of the point's own, V gamma g_0 / (h N_1).
  struct LeadingEdge
  {
    struct Point
    {
      unsigned int point;
      /// of the slip along x and y [m/(s N)]
      std::array<double, 2> compliance;
      /// what the rows of the slip, with this compliance, are multiplied by [-]
      std::array<double, 2> weight;
    };
    std::vector<Point> points;

    /// @param ratio gamma along x and y [-]
    /// @param A operator of the contact without an edge
    /// @param normal gap and normal force of all points
    LeadingEdge(const ContactGrid &grid, const std::array<double, 2> &ratio, double speed,
                const ContactOperator &A, const ContactSolution &normal);
    LeadingEdge() = default;
    /// whether a problem with these would hardly differ from one with others
    bool equals(const LeadingEdge &other) const;
    /// Compliances and weights into the rows of a problem without them. Weights keep the diagonal of A what it is for other
    /// points, one augmentation parameter for all: Newton's steps cycle otherwise. Any positive weight leaves the law what it is.
    void add_to(ContactProblem &problem) const;
    LeadingEdge without_weights() const;
    /// Slips of a solution of the weighted problem to what they are without weights.
    void take_weights(DenseVector &y) const;
  };

  /// First-order upwind, the slip being taken in the middle of the difference: the scheme that goes with LeadingEdge.
  const CreepScheme &leading_edge_scheme();
} // namespace vibrocontact
