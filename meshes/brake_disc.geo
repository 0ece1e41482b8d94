// A brake disc of hexahedra: a flat ring, held at its bore, with both faces in the group that pads rub on. In mm.
DefineConstant[ around = 88, across = 9, through = 1 ];
inner = 50; outer = 140; thickness = 12;
Point(1) = {inner, 0, -thickness / 2};
Point(2) = {outer, 0, -thickness / 2};
Line(1) = {1, 2};
Transfinite Curve {1} = across + 1;
quarter[] = {1};
surfaces[] = {};
For k In {0:3}
  out[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Curve{quarter[0]}; Layers{around / 4}; Recombine; };
  quarter[0] = out[0];
  surfaces[] += out[1];
EndFor
bore[] = {}; rim[] = {}; top[] = {}; solid[] = {};
For k In {0:3}
  out[] = Extrude {0, 0, thickness} { Surface{surfaces[k]}; Layers{through}; Recombine; };
  top[] += out[0];
  solid[] += out[1];
  rim[] += out[3];
  bore[] += out[5];
EndFor
Physical Surface("faces") = {surfaces[], top[]};
Physical Surface("bore") = {bore[]};
Physical Surface("rim") = {rim[]};
Physical Volume("steel") = {solid[]};
