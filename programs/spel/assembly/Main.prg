Global Integer n
Function main

	InitRobot
	Print "Go pickUp; not a motion"
	Go park
	Do
		Jump3 pickUp -Z(60), pickUp -Z(40), pickUp
		' Move pickUp
		On 8; Wait 0.1; Move pickUp +Z(80) CP
		Go tray1 :Z(150) CP
		Move Tray1
		If Sw(3) = On Then Move tray2 Else Move P4 CP
		Select n
			Case 1
				Move P(2)
			Case 2
				Go P(20 + n)
			Default
				Go notTaught
		Send
		Go P5
		Arc arcVia, P6 CP
		seen = Here +Z(5)
		Move seen
		Go turned
		P13 = XY(406.49,56.83,345.29,-176.92,0.74,175.79) /R /A
		Go const
		Go XY(246.180, 164.939, 214.959, 159.144, -1.914, 173.132) /1
		Go JA(0,-10,10,0,45,0)
		TMove XY(0,0,-20,0)
		Move tray2 /L
	Loop Until Sw(4) = On
	GoHome()

Fend

Function GoHome
	Go park
Fend
