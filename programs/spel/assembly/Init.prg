' Project assembly: set up
Function InitRobot

	Reset; Motor On
	Power High
	TLSet 1, XY(12, -8, 95, 0, 20, 0)
	Local 1, XY(260, -120, 120, 30, 0, 0)
	Local 2, P10, P11, P12	' taught plane
	Tool 1
	LoadPoints "robot1.pts"

Fend
