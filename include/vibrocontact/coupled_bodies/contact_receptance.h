#pragma once

#include <vibrocontact/coupled_bodies/linearised_contact.h>
#include <vibrocontact/coupled_bodies/patch_receptance.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// The contact's own equations at a complex frequency: closed gaps and sliding friction with R = E_N N + E_z z
  /// (SlidingFrame) and the receptance of the bodies at the contact, H(s) = W~ + sum of basis G(s) forces^T,
  ///
  ///   F(s) (N, z) = 0:      n: H_n R = 0 (hub fixed; force given: H_n R = const, sum dN = 0)
  ///                         b: (V d/dx + s) H_b R + z / c_b = 0
  ///
  /// V d/dx is that of the pair: differences between points, and gradients of bodies that bring some. Rests that relax stand in
  /// H with W / (1 + beta s), those with a loss factor with W / (1 + j eta). Roots of the linearised
  /// contact make F singular, and no state matrix appears. Constant friction and the consistent linearisation.
  class ContactReceptance
  {
  public:
    /// @param loss of the pair, or null @param further bodies that the pair has not got, or that the loss
    /// has exactly
    ContactReceptance(const ContactPair &pair, const CreepScheme &scheme,
                      const RollingEquilibrium &equilibrium, const HystereticLoss *loss = nullptr,
                      std::vector<PatchReceptance> further = {});
    /// @param receptances of all bodies that move the contact, by patch_receptances() or otherwise, body 1 first
    ContactReceptance(const ContactPair &pair, const CreepScheme &scheme,
                      const RollingEquilibrium &equilibrium, std::vector<PatchReceptance> receptances,
                      const HystereticLoss *loss);

    /// F(s), equations and unknowns by contact points
    ComplexMatrix value(const std::complex<double> &s) const;
    /// dF/ds; analytic of modes and rests, of functions without a derivative by central differences of fourth order
    ComplexMatrix derivative(const std::complex<double> &s) const;
    /// F(s) x and dF/ds x, without F
    ComplexVector times(const std::complex<double> &s, const ComplexVector &x) const;
    ComplexVector derivative_times(const std::complex<double> &s, const ComplexVector &x) const;
    unsigned int size() const { return at_once.constant.m(); }
    /// T(s), what all but body 1 answers at its patch shapes: with R_1(s) and S_1 rows and shares of these shapes, G_1 their
    /// receptance, F = F' + R_1 G_1 S_1,
    ///
    ///   T = S_1 F'^-1 R_1,     det F = det F' det(1 + G_1 T)
    ///
    /// so that forces T y on body 1 hold a motion y of its patch up. Rank of basis_of_first() square [N/m].
    ComplexMatrix seen_by_first(const std::complex<double> &s) const;
    /// The patch shapes of body 1, 3 n x rank. @pre it has modes
    const DenseMatrix &basis_of_first() const { return bodies.at(first).receptance.basis; }
    /// p of det F ~ s^p at infinity
    int power() const { return power_of_s; }
    /// Which unknown (and equation) each is, ascending: 3 point + 0 for N, + 1 for z, + 2 for the second z of a point that sticks;
    /// the approach behind all of them. Cases whose points differ know each other's forces by it.
    const std::vector<unsigned int> &unknowns() const { return places; }

  private:
    /// constant + s linear
    struct Rows
    {
      ComplexMatrix constant, linear;
      ComplexMatrix at(const std::complex<double> &s) const;
    };
    struct Rest
    {
      double relaxation;
      Rows rows;
    };
    struct Body
    {
      PatchReceptance receptance;
      /// rows that its shapes move, and shares of the unknowns in its shapes
      Rows rows;
      ComplexMatrix shares;
    };

    Rows at_once;
    std::vector<Rest> rests;
    std::vector<Body> bodies;
    std::vector<unsigned int> places;
    int power_of_s = 0;
    /// place of body 1 among the bodies
    std::size_t first = -1;

    /// F(s) but for one of the bodies
    ComplexMatrix value_without(std::size_t left_out, const std::complex<double> &s) const;
  };
} // namespace vibrocontact
