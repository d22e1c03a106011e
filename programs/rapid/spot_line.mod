%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE SpotLine_R2
  ! ****************************************************************
  ! Schweißstation 20, Roboter R2: Längsträger links, zwei Vorrichtungen
  ! Punktabstand 33 mm, Elektrodenkraft 3,2 kN. Prüfer: Hr. Jäger
  ! Alter Punkt (nicht löschen): pS999:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  ! ****************************************************************

  PERS tooldata tGun:=[TRUE,[[-312.5,-18.2,455.3],[0.866025,0,-0.5,0]],[86.4,[-210.5,-12,318.6],[1,0,0,0],4.1,5.6,3.2]];
  PERS tooldata tGeo:=[TRUE,[[0,0,384.5],[0.92388,0,0,0.382683]],[42,[0,0,165],[1,0,0,0],0,0,0]];
  ! Gleiches Teil auf zwei Vorrichtungen
  TASK PERS wobjdata wobFixA:=[FALSE,TRUE,"",[[1250.4,-650.2,620.5],[0.999914,0,0,-0.01309]],[[120,60,35.5],[0.99956,-0.000247,0.008723,0.028357]]];
  TASK PERS wobjdata wobFixB:=[FALSE,TRUE,"",[[1251.9,-95.4,624.1],[0.999807,0,0,0.019634]],[[118.5,61.2,34.8],[0.999655,-0.000177,0.006979,0.025304]]];
  PERS wobjdata wobMag:=[FALSE,TRUE,"",[[300.5,-1620.3,715.2],[0.707107,0,0,0.707107]],[[0,0,0],[1,0,0,0]]];
  PERS loaddata ldTraeger:=[18.6,[35,0,210],[1,0,0,0],0,0,0];

  CONST spotdata sd12:=[12,1,3200];
  CONST gundata gd1:=[1,1,0,0,0,0,0,0,0,FALSE,0];

  CONST robtarget pHome:=[[1691.34,29.9,1576.99],[0.706063,0.030617,0.707376,0.012543],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pVorPick:=[[310,-120,154.5],[0,0.996195,-0.087156,0],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPick:=[[310,-120,4.5],[0,0.996195,-0.087156,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pVorS:=[[40,30,290],[-0.047201,0.964487,0.256543,0.041502],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS101:=[[60,30,180],[-0.047201,0.964487,0.256543,0.041502],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS102:=[[93.08,35.72,178.12],[-0.045727,0.961216,0.269694,0.035174],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS103:=[[126.15,41.13,172.66],[-0.043296,0.957888,0.282357,0.029147],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS104:=[[159.23,45.96,164.13],[-0.039943,0.954662,0.294065,0.023459],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS105:=[[192.31,49.94,153.34],[-0.035733,0.951704,0.304391,0.018132],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS106:=[[225.38,52.86,141.29],[-0.03075,0.949176,0.312963,0.013162],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS107:=[[258.46,54.57,129.12],[-0.025103,0.947224,0.319473,0.008524],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS108:=[[291.54,54.98,117.98],[-0.018915,0.945965,0.323691,0.004166],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS109:=[[324.62,54.06,108.9],[-0.012318,0.945474,0.325465,0.000018],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS110:=[[357.69,51.87,102.74],[-0.005457,0.945783,0.32473,-0.004003],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS111:=[[390.77,48.51,100.08],[0.001521,0.946872,0.321509,-0.00799],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS112:=[[423.85,44.18,101.18],[0.008468,0.948674,0.315912,-0.012037],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS113:=[[456.92,39.1,105.91],[0.015236,0.951083,0.308132,-0.016228],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pS114:=[[490,33.53,113.85],[0.021681,0.953958,0.298442,-0.020636],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pReserve:=[[159.23,45.96,164.13],[-0.039943,0.954662,0.294065,0.023459],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];   ! nirgends angefahren

  PROC main()
    GripLoad load0;
    MoveJ pHome,v1000,fine,tGun;
    HoleTeil;
    IF diFixA=1 THEN
      SchweissenA;
    ELSEIF diFixB=1 THEN
      SchweissenB;
    ENDIF
    MoveJ pHome,v1000,fine,tGun;
  ENDPROC

  PROC HoleTeil()
    MoveJ pVorPick,v1500,z50,tGeo\WObj:=wobMag;
    MoveL pPick,v100,fine,tGeo\WObj:=wobMag;
    Set doVac;
    GripLoad ldTraeger;
    MoveL Offs(pPick,0,0,80),v250,z20,tGeo\WObj:=wobMag;
    WaitTime 0.3;   ! Ablage hier nicht gezeigt
    Reset doVac;
    GripLoad load0;
  ENDPROC

  PROC SchweissenA()
    MoveJ pVorS,v1500,z50,tGun\WObj:=wobFixA;
    SpotL pS101,vmax,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS102,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS103,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS104,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS105,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS106,vmax,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS107,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS108,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS109,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS110,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS111,vmax,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS112,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS113,v500,gd1,sd12,tGun\WObj:=wobFixA;
    SpotL pS114,v500,gd1,sd12,tGun\WObj:=wobFixA;
    movel Offs(pVorS,0,0,60),v800,z50,tGun\Wobj:=wobfixa;
  ENDPROC

  PROC SchweissenB()
    MoveJ pVorS,v1500,z50,tGun\WObj:=wobFixB;
    SpotL pS101,vmax,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS102,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS103,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS104,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS105,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS106,vmax,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS107,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS108,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS109,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS110,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS111,vmax,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS112,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS113,v500,gd1,sd12,tGun\WObj:=wobFixB;
    SpotL pS114,v500,gd1,sd12,tGun\WObj:=wobFixB;
    movel Offs(pVorS,0,0,60),v800,z50,tGun\Wobj:=wobfixb;
  ENDPROC

ENDMODULE
