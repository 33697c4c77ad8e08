// Half of a strip load of width 2 m on a layer of soil; x = 0 is the plane of symmetry. A footing stands on the soil where
// it is thicker than nothing, and carries the load then.
half = 1;
width = 4;
depth = 2;
footing = 0;
Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, depth, 0};
Point(4) = {half, depth, 0};
Point(5) = {0, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("side") = {2};
If (footing > 0)
    Point(6) = {half, depth + footing, 0};
    Point(7) = {0, depth + footing, 0};
    Line(6) = {4, 6};
    Line(7) = {6, 7};
    Line(8) = {7, 5};
    Curve Loop(2) = {-4, 6, 7, 8};
    Plane Surface(2) = {2};
    Physical Surface("footing") = {2};
    Physical Curve("strip") = {7};
    Physical Curve("middle") = {5, 8};
Else
    Physical Curve("strip") = {4};
    Physical Curve("middle") = {5};
EndIf
