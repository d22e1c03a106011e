! Umsetzen von Gehäusen – Zelle 7 (UTF-8)
MODULE Handling (NOSTEPIN)
  LOCAL CONST num nHub:=120;
  LOCAL PERS tooldata tGreifer := [ TRUE, [[0,0,312.6],[0.9659258,0,0,-0.258819]], [ 31.2, [0,0,140], [1,0,0,0], 0, 0, 0 ] ];
  LOCAL PERS wobjdata wTisch := [ FALSE, TRUE, "", [[1450.2,-380.7,802.3],[0.9940563,0,0,0.1088669]], [[0,0,0],[1,0,0,0]] ];
  LOCAL PERS loaddata ldTeil := [ 6.35, [0, 4.5, 42], [1,0,0,0], 0, 0, 0 ];
  LOCAL CONST jointtarget jHome := [[0,-20,20,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  LOCAL CONST jointtarget jWarten{2} := [
    [[-35.5,5,12.25,0,70,-10],[9E9,9E9,9E9,9E9,9E9,9E9]],
    [[35.5,5,12.25,0,70,10],[9E9,9E9,9E9,9E9,9E9,9E9]]
  ];
  LOCAL CONST robtarget pNest{6} := [
    [[80,60,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],   ! Nest 1
    [[190,60,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],   ! Nest 2
    [[300,60,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],   ! Nest 3
    [[80,150,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],   ! Nest 4
    [[190,150,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],   ! Nest 5
    [[300,150,22.5],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]]   ! Nest 6
  ];
  LOCAL CONST robtarget pBogenA := [[90,240,140],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  LOCAL CONST robtarget pBogenM := [[220,370,140],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  LOCAL CONST robtarget pBogenE := [[350,240,140],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  LOCAL VAR robtarget pIst;
  LOCAL VAR robtarget pGefunden;
  LOCAL CONST robtarget pSuch := [[260,-60,40],[-0.0624727,0.9966703,-0.041383,-0.03214],[-1,0,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ jHome\NoEOffs, v1000, fine, tGreifer;
    GripLoad load0;
    FOR i FROM 1 TO 6 DO
      MoveJ Offs(pNest{i},0,0,nHub), v1500, z50, tGreifer\WObj:=wTisch;  ! berechnet
      MoveL pNest{i}, v200, fine, tGreifer, \WObj:=wTisch;
      Set doGreifer;
      GripLoad ldTeil;
      MoveL RelTool(pNest{1},0,0,-120), v500, z20, tGreifer\WObj:=wTisch;
      Bogen;
      GripLoad load0;
    ENDFOR
    MoveAbsJ jWarten{1}, v800, z50, tGreifer;
    MoveAbsJ jWarten{2}, v800, fine, tGreifer;
    MoveL Offs(pNest{2},0,0,80), v500, z10, tGreifer\WObj:=wTisch;
    MoveL RelTool(pNest{3},-2.5,0,-60\Rz:=-15), v500, fine, tGreifer\WObj:=wTisch;
    Suchen;
  ENDPROC

  LOCAL PROC Bogen()
    MoveL pBogenA, v500, z10, tGreifer\WObj:=wTisch;
    MoveC pBogenM, pBogenE, v300, z10, tGreifer\WObj:=wTisch;
  ENDPROC

  LOCAL PROC Suchen()
    SearchL\SStop, diKontakt, pGefunden, pSuch, v20, tGreifer\WObj:=wTisch;
    MoveL pGefunden, v50, fine, tGreifer\WObj:=wTisch;
    pIst:=CRobT(\Tool:=tGreifer\WObj:=wTisch);
    MoveL Offs(pIst,0,0,50), v200, fine, tGreifer\WObj:=wTisch;
  ENDPROC
ENDMODULE