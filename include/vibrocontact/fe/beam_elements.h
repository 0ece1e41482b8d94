#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/fe/trace_row.h>
#include <vibrocontact/scene/beam_rail.h>
#include <vibrocontact/scene/material.h>

#include <memory>

namespace vibrocontact
{
  /// Finite elements of a rail as a beam (FE_Q<1>, seven fields, consistent mass, full integration).
  ///
  /// A section moves as a rigid one and warps: with eta, zeta lateral and vertical places in the section
  /// (index c from the centroid, s from the shear centre), t = (tx, ty, tz) its rotation, V at the shear
  /// centre, p the amplitude of Saint-Venant's warping function w,
  ///
  ///   u_x = U + zeta_c ty - eta tz + p w,   u_y = V - zeta_s tx,   u_z = W + eta tx
  ///
  ///   2 E_pot = int E A U'^2 + E Iy ty'^2 + E Iz tz'^2 + kz G A (W' + ty)^2 + ky G A (V' - tz)^2
  ///                 + G J tx'^2 + G (Ip - J) (tx' - p)^2 + E Iw p'^2 dx
  ///   2 E_kin = int rho (A U.^2 + A (V - e tx).^2 + A W.^2 + (Iy + Iz) tx.^2 + Iy ty.^2 + Iz tz.^2 + Iw
  ///   p.^2) dx
  ///
  /// e: height of the centroid over the shear centre, Ip the polar moment about the latter (Timoshenko 1921;
  /// Benscoter 1954 for the torsion: p is not forced to be tx'). Pads hold the foot: Kx u_x^2 + Ky u_y^2 + Kz
  /// u_z^2, spread over the foot's width (which holds tx and tz) and along x, or in a point. Rotary motion of
  /// the foot about y by the pad's length is in W(x). Hysteretic loss by rail, anechoic pieces and pads.
  ///
  /// The trace moves rigidly with the section over x = 0 (rank 6): a contact on the crown at the lever zeta_s
  /// twists the beam by its lateral force. The warping of the head and the strain of the crown under the
  /// bending moment are left out of it. What the crown gives way under the contact itself is not in the
  /// beam: MeshedBody adds a half-space of the rail's material as local_compliance.
  std::unique_ptr<SecondOrderSystem> assemble_beam_rail(const BeamRailParameters &rail,
                                                        const ElasticMaterial &material,
                                                        const std::string &name, const ContactGrid *grid,
                                                        MPI_Comm communicator);

  /// Mean motion of a piece of the beam's crown, no local part: rows normal, x, y as those of a trace. From
  /// x - length / 2 to x + length / 2, at y from the contact point [m].
  /// @throws InputError if the piece leaves the rail
  std::vector<TraceRow> beam_rail_rows(const BeamRailParameters &rail, const std::string &name, double x,
                                       double y, double length);
} // namespace vibrocontact
