MODULE DoorSeal
  ! Door panel in the gripper, dispensing nozzle on a pedestal
  PERS tooldata tNozzle:=[FALSE,[[1780.6,-250.3,1105.2],[0.981432,0.084745,-0.029213,0.169578]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];
  PERS wobjdata wDoor:=[TRUE,TRUE,"",[[0,25,180],[0.991445,0,0,0.130526]],[[0,0,0],[1,0,0,0]]];
  PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[38,[0,5,95],[1,0,0,0],0,0,0]];
  PERS loaddata ldDoor:=[14.2,[0,20,60],[1,0,0,0],0,0,0];

  CONST robtarget pOver:=[[-130,-90,30],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    GripLoad ldDoor;
    MoveAbsJ [[-10.2,26.61,-5.14,11.02,69.06,131.2],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tGrip;
    MoveJ pOver,v300,z5,tNozzle\WObj:=wDoor;
    DispL\On, [[-130,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-97.5,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-65,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-32.5,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[0,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[32.5,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[65,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[97.5,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,-60,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,-30,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,0,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,30,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,60,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[130,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[97.5,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[65,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[32.5,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[0,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-32.5,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-65,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-97.5,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,60,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,30,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,0,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,-30,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL [[-130,-60,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    DispL\Off, [[-130,-90,0],[0,1,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v80,bead1,z1,tNozzle\WObj:=wDoor;
    MoveL pOver,v300,fine,tNozzle\WObj:=wDoor;
  ENDPROC
ENDMODULE
