For i In {0:3}
  Point(i) = {i, 0, 0};
EndFor
Macro Again
  Call Again;
Return
