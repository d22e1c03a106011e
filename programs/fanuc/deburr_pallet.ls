/PROG deburr_pallet
/ATTR
OWNER       = MNEDITOR;
CREATE      = DATE 126-01-20  TIME 09:43:21;
MODIFIED    = DATE 126-01-20  TIME 09:43:21;
LINE_COUNT = 420;
PROTECT     = READ_WRITE;
DEFAULT_GROUP   = 1,*,*,*,*;
CONTROL_CODE    = 00000000 00000000;
/MN
: UFRAME_NUM=3;
: UTOOL_NUM=3;
1: L P[1] 240cm/min CNT100   ;
2: L P[2] 240cm/min CNT100   ;
3: L P[3] 240cm/min CNT100   ;
4: L P[4] 240cm/min CNT100   ;
5: L P[5] 240cm/min CNT100   ;
6: L P[6] 240cm/min CNT100   ;
7: L P[7] 240cm/min CNT100   ;
8: L P[8] 240cm/min CNT100   ;
9: L P[9] 240cm/min CNT100   ;
10: L P[10] 240cm/min CNT100   ;
11: L P[11] 240cm/min CNT100   ;
12: L P[12] 240cm/min CNT100   ;
13: L P[13] 240cm/min CNT100   ;
14: L P[14] 240cm/min CNT100   ;
15: L P[15] 240cm/min CNT100   ;
16: L P[16] 240cm/min CNT100   ;
17: L P[17] 240cm/min CNT100   ;
18: L P[18] 240cm/min CNT100   ;
19: L P[19] 240cm/min CNT100   ;
20: L P[20] 240cm/min CNT100   ;
21: L P[21] 240cm/min CNT100   ;
22: L P[22] 240cm/min CNT100   ;
23: L P[23] 240cm/min CNT100   ;
24: L P[24] 240cm/min CNT100   ;
25: L P[25] 240cm/min CNT100   ;
26: L P[26] 240cm/min CNT100   ;
27: L P[27] 240cm/min CNT100   ;
28: L P[28] 240cm/min CNT100   ;
29: L P[29] 240cm/min CNT100   ;
30: L P[30] 240cm/min CNT100   ;
31: L P[31] 240cm/min CNT100   ;
32: L P[32] 240cm/min CNT100   ;
33: L P[33] 240cm/min CNT100   ;
34: L P[34] 240cm/min CNT100   ;
35: L P[35] 240cm/min CNT100   ;
36: L P[36] 240cm/min CNT100   ;
37: L P[37] 240cm/min CNT100   ;
38: L P[38] 240cm/min CNT100   ;
39: L P[39] 240cm/min CNT100   ;
40: L P[40] 240cm/min CNT100   ;
41: L P[41] 240cm/min CNT100   ;
42: L P[42] 240cm/min CNT100   ;
43: L P[43] 240cm/min CNT100   ;
44: L P[44] 240cm/min CNT100   ;
45: L P[45] 240cm/min CNT100   ;
46: L P[46] 240cm/min CNT100   ;
47: L P[47] 240cm/min CNT100   ;
48: L P[48] 240cm/min CNT100   ;
49: L P[49] 240cm/min CNT100   ;
50: L P[50] 240cm/min CNT100   ;
51: L P[51] 240cm/min CNT100   ;
52: L P[52] 240cm/min CNT100   ;
53: L P[53] 240cm/min CNT100   ;
54: L P[54] 240cm/min CNT100   ;
55: L P[55] 240cm/min CNT100   ;
56: L P[56] 240cm/min CNT100   ;
57: L P[57] 240cm/min CNT100   ;
58: L P[58] 240cm/min CNT100   ;
59: L P[59] 240cm/min CNT100   ;
60: L P[60] 240cm/min CNT100   ;
61: L P[61] 240cm/min CNT100   ;
62: L P[62] 240cm/min CNT100   ;
63: L P[63] 240cm/min CNT100   ;
64: L P[64] 240cm/min CNT100   ;
65: L P[65] 240cm/min CNT100   ;
66: L P[66] 240cm/min CNT100   ;
67: L P[67] 240cm/min CNT100   ;
68: L P[68] 240cm/min CNT100   ;
69: L P[69] 240cm/min CNT100   ;
70: L P[70] 240cm/min CNT100   ;
71: L P[71] 240cm/min CNT100   ;
72: L P[72] 240cm/min CNT100   ;
73: L P[73] 240cm/min CNT100   ;
74: L P[74] 240cm/min CNT100   ;
75: L P[75] 240cm/min CNT100   ;
76: L P[76] 240cm/min CNT100   ;
77: L P[77] 240cm/min CNT100   ;
78: L P[78] 240cm/min CNT100   ;
79: L P[79] 240cm/min CNT100   ;
80: L P[80] 240cm/min CNT100   ;
81: L P[81] 240cm/min CNT100   ;
82: L P[82] 240cm/min CNT100   ;
83: L P[83] 240cm/min CNT100   ;
84: L P[84] 240cm/min CNT100   ;
85: L P[85] 240cm/min CNT100   ;
86: L P[86] 240cm/min CNT100   ;
87: L P[87] 240cm/min CNT100   ;
88: L P[88] 240cm/min CNT100   ;
89: L P[89] 240cm/min CNT100   ;
90: L P[90] 240cm/min CNT100   ;
91: L P[91] 240cm/min CNT100   ;
92: L P[92] 240cm/min CNT100   ;
93: L P[93] 240cm/min CNT100   ;
94: L P[94] 240cm/min CNT100   ;
95: L P[95] 240cm/min CNT100   ;
96: L P[96] 240cm/min CNT100   ;
97: L P[97] 240cm/min CNT100   ;
98: L P[98] 240cm/min CNT100   ;
99: L P[99] 240cm/min CNT100   ;
100: L P[100] 240cm/min CNT100   ;
101: L P[101] 240cm/min CNT100   ;
102: L P[102] 240cm/min CNT100   ;
103: L P[103] 240cm/min CNT100   ;
104: L P[104] 240cm/min CNT100   ;
105: L P[105] 240cm/min CNT100   ;
106: L P[106] 240cm/min CNT100   ;
107: L P[107] 240cm/min CNT100   ;
108: L P[108] 240cm/min CNT100   ;
109: L P[109] 240cm/min CNT100   ;
110: L P[110] 240cm/min CNT100   ;
111: L P[111] 240cm/min CNT100   ;
112: L P[112] 240cm/min CNT100   ;
113: L P[113] 240cm/min CNT100   ;
114: L P[114] 240cm/min CNT100   ;
115: L P[115] 240cm/min CNT100   ;
116: L P[116] 240cm/min CNT100   ;
117: L P[117] 240cm/min CNT100   ;
118: L P[118] 240cm/min CNT100   ;
119: L P[119] 240cm/min CNT100   ;
120: L P[120] 240cm/min CNT100   ;
121: L P[121] 240cm/min CNT100   ;
122: L P[122] 240cm/min CNT100   ;
123: L P[123] 240cm/min CNT100   ;
124: L P[124] 240cm/min CNT100   ;
125: L P[125] 240cm/min CNT100   ;
126: L P[126] 240cm/min CNT100   ;
127: L P[127] 240cm/min CNT100   ;
128: L P[128] 240cm/min CNT100   ;
129: L P[129] 240cm/min CNT100   ;
130: L P[130] 240cm/min CNT100   ;
131: L P[131] 240cm/min CNT100   ;
132: L P[132] 240cm/min CNT100   ;
133: L P[133] 240cm/min CNT100   ;
134: L P[134] 240cm/min CNT100   ;
135: L P[135] 240cm/min CNT100   ;
136: L P[136] 240cm/min CNT100   ;
137: L P[137] 240cm/min CNT100   ;
138: L P[138] 240cm/min CNT100   ;
139: L P[139] 240cm/min CNT100   ;
140: L P[140] 240cm/min CNT100   ;
141: L P[141] 240cm/min CNT100   ;
142: L P[142] 240cm/min CNT100   ;
143: L P[143] 240cm/min CNT100   ;
144: L P[144] 240cm/min CNT100   ;
145: L P[145] 240cm/min CNT100   ;
146: L P[146] 240cm/min CNT100   ;
147: L P[147] 240cm/min CNT100   ;
148: L P[148] 240cm/min CNT100   ;
149: L P[149] 240cm/min CNT100   ;
150: L P[150] 240cm/min CNT100   ;
151: L P[151] 240cm/min CNT100   ;
152: L P[152] 240cm/min CNT100   ;
153: L P[153] 240cm/min CNT100   ;
154: L P[154] 240cm/min CNT100   ;
155: L P[155] 240cm/min CNT100   ;
156: L P[156] 240cm/min CNT100   ;
157: L P[157] 240cm/min CNT100   ;
158: L P[158] 240cm/min CNT100   ;
159: L P[159] 240cm/min CNT100   ;
160: L P[160] 240cm/min CNT100   ;
161: L P[161] 240cm/min CNT100   ;
162: L P[162] 240cm/min CNT100   ;
163: L P[163] 240cm/min CNT100   ;
164: L P[164] 240cm/min CNT100   ;
165: L P[165] 240cm/min CNT100   ;
166: L P[166] 240cm/min CNT100   ;
167: L P[167] 240cm/min CNT100   ;
168: L P[168] 240cm/min CNT100   ;
169: L P[169] 240cm/min CNT100   ;
170: L P[170] 240cm/min CNT100   ;
171: L P[171] 240cm/min CNT100   ;
172: L P[172] 240cm/min CNT100   ;
173: L P[173] 240cm/min CNT100   ;
174: L P[174] 240cm/min CNT100   ;
175: L P[175] 240cm/min CNT100   ;
176: L P[176] 240cm/min CNT100   ;
177: L P[177] 240cm/min CNT100   ;
178: L P[178] 240cm/min CNT100   ;
179: L P[179] 240cm/min CNT100   ;
180: L P[180] 240cm/min CNT100   ;
181: L P[181] 240cm/min CNT100   ;
182: L P[182] 240cm/min CNT100   ;
183: L P[183] 240cm/min CNT100   ;
184: L P[184] 240cm/min CNT100   ;
185: L P[185] 240cm/min CNT100   ;
186: L P[186] 240cm/min CNT100   ;
187: L P[187] 240cm/min CNT100   ;
188: L P[188] 240cm/min CNT100   ;
189: L P[189] 240cm/min CNT100   ;
190: L P[190] 240cm/min CNT100   ;
191: L P[191] 240cm/min CNT100   ;
192: L P[192] 240cm/min CNT100   ;
193: L P[193] 240cm/min CNT100   ;
194: L P[194] 240cm/min CNT100   ;
195: L P[195] 240cm/min CNT100   ;
196: L P[196] 240cm/min CNT100   ;
197: L P[197] 240cm/min CNT100   ;
198: L P[198] 240cm/min CNT100   ;
199: L P[199] 240cm/min CNT100   ;
200: L P[200] 240cm/min CNT100   ;
201: L P[201] 240cm/min CNT100   ;
202: L P[202] 240cm/min CNT100   ;
203: L P[203] 240cm/min CNT100   ;
204: L P[204] 240cm/min CNT100   ;
205: L P[205] 240cm/min CNT100   ;
206: L P[206] 240cm/min CNT100   ;
207: L P[207] 240cm/min CNT100   ;
208: L P[208] 240cm/min CNT100   ;
209: L P[209] 240cm/min CNT100   ;
210: L P[210] 240cm/min CNT100   ;
211: L P[211] 240cm/min CNT100   ;
212: L P[212] 240cm/min CNT100   ;
213: L P[213] 240cm/min CNT100   ;
214: L P[214] 240cm/min CNT100   ;
215: L P[215] 240cm/min CNT100   ;
216: L P[216] 240cm/min CNT100   ;
217: L P[217] 240cm/min CNT100   ;
218: L P[218] 240cm/min CNT100   ;
219: L P[219] 240cm/min CNT100   ;
220: L P[220] 240cm/min CNT100   ;
221: L P[221] 240cm/min CNT100   ;
222: L P[222] 240cm/min CNT100   ;
223: L P[223] 240cm/min CNT100   ;
224: L P[224] 240cm/min CNT100   ;
225: L P[225] 240cm/min CNT100   ;
226: L P[226] 240cm/min CNT100   ;
227: L P[227] 240cm/min CNT100   ;
228: L P[228] 240cm/min CNT100   ;
229: L P[229] 240cm/min CNT100   ;
230: L P[230] 240cm/min CNT100   ;
231: L P[231] 240cm/min CNT100   ;
232: L P[232] 240cm/min CNT100   ;
233: L P[233] 240cm/min CNT100   ;
234: L P[234] 240cm/min CNT100   ;
235: L P[235] 240cm/min CNT100   ;
236: L P[236] 240cm/min CNT100   ;
237: L P[237] 240cm/min CNT100   ;
238: L P[238] 240cm/min CNT100   ;
239: L P[239] 240cm/min CNT100   ;
240: L P[240] 240cm/min CNT100   ;
241: L P[241] 240cm/min CNT100   ;
242: L P[242] 240cm/min CNT100   ;
243: L P[243] 240cm/min CNT100   ;
244: L P[244] 240cm/min CNT100   ;
245: L P[245] 240cm/min CNT100   ;
246: L P[246] 240cm/min CNT100   ;
247: L P[247] 240cm/min CNT100   ;
248: L P[248] 240cm/min CNT100   ;
249: L P[249] 240cm/min CNT100   ;
250: L P[250] 240cm/min CNT100   ;
251: L P[251] 240cm/min CNT100   ;
252: L P[252] 240cm/min CNT100   ;
253: L P[253] 240cm/min CNT100   ;
254: L P[254] 240cm/min CNT100   ;
255: L P[255] 240cm/min CNT100   ;
256: L P[256] 240cm/min CNT100   ;
257: L P[257] 240cm/min CNT100   ;
258: L P[258] 240cm/min CNT100   ;
259: L P[259] 240cm/min CNT100   ;
260: L P[260] 240cm/min CNT100   ;
261: L P[261] 240cm/min CNT100   ;
262: L P[262] 240cm/min CNT100   ;
263: L P[263] 240cm/min CNT100   ;
264: L P[264] 240cm/min CNT100   ;
265: L P[265] 240cm/min CNT100   ;
266: L P[266] 240cm/min CNT100   ;
267: L P[267] 240cm/min CNT100   ;
268: L P[268] 240cm/min CNT100   ;
269: L P[269] 240cm/min CNT100   ;
270: L P[270] 240cm/min CNT100   ;
271: L P[271] 240cm/min CNT100   ;
272: L P[272] 240cm/min CNT100   ;
273: L P[273] 240cm/min CNT100   ;
274: L P[274] 240cm/min CNT100   ;
275: L P[275] 240cm/min CNT100   ;
276: L P[276] 240cm/min CNT100   ;
277: L P[277] 240cm/min CNT100   ;
278: L P[278] 240cm/min CNT100   ;
279: L P[279] 240cm/min CNT100   ;
280: L P[280] 240cm/min CNT100   ;
281: L P[281] 240cm/min CNT100   ;
282: L P[282] 240cm/min CNT100   ;
283: L P[283] 240cm/min CNT100   ;
284: L P[284] 240cm/min CNT100   ;
285: L P[285] 240cm/min CNT100   ;
286: L P[286] 240cm/min CNT100   ;
287: L P[287] 240cm/min CNT100   ;
288: L P[288] 240cm/min CNT100   ;
289: L P[289] 240cm/min CNT100   ;
290: L P[290] 240cm/min CNT100   ;
291: L P[291] 240cm/min CNT100   ;
292: L P[292] 240cm/min CNT100   ;
293: L P[293] 240cm/min CNT100   ;
294: L P[294] 240cm/min CNT100   ;
295: L P[295] 240cm/min CNT100   ;
296: L P[296] 240cm/min CNT100   ;
297: L P[297] 240cm/min CNT100   ;
298: L P[298] 240cm/min CNT100   ;
299: L P[299] 240cm/min CNT100   ;
300: L P[300] 240cm/min CNT100   ;
301: L P[301] 240cm/min CNT100   ;
302: L P[302] 240cm/min CNT100   ;
303: L P[303] 240cm/min CNT100   ;
304: L P[304] 240cm/min CNT100   ;
305: L P[305] 240cm/min CNT100   ;
306: L P[306] 240cm/min CNT100   ;
307: L P[307] 240cm/min CNT100   ;
308: L P[308] 240cm/min CNT100   ;
309: L P[309] 240cm/min CNT100   ;
310: L P[310] 240cm/min CNT100   ;
311: L P[311] 240cm/min CNT100   ;
312: L P[312] 240cm/min CNT100   ;
313: L P[313] 240cm/min CNT100   ;
314: L P[314] 240cm/min CNT100   ;
315: L P[315] 240cm/min CNT100   ;
316: L P[316] 240cm/min CNT100   ;
317: L P[317] 240cm/min CNT100   ;
318: L P[318] 240cm/min CNT100   ;
319: L P[319] 240cm/min CNT100   ;
320: L P[320] 240cm/min CNT100   ;
321: L P[321] 240cm/min CNT100   ;
322: L P[322] 240cm/min CNT100   ;
323: L P[323] 240cm/min CNT100   ;
324: L P[324] 240cm/min CNT100   ;
325: L P[325] 240cm/min CNT100   ;
326: L P[326] 240cm/min CNT100   ;
327: L P[327] 240cm/min CNT100   ;
328: L P[328] 240cm/min CNT100   ;
329: L P[329] 240cm/min CNT100   ;
330: L P[330] 240cm/min CNT100   ;
331: L P[331] 240cm/min CNT100   ;
332: L P[332] 240cm/min CNT100   ;
333: L P[333] 240cm/min CNT100   ;
334: L P[334] 240cm/min CNT100   ;
335: L P[335] 240cm/min CNT100   ;
336: L P[336] 240cm/min CNT100   ;
337: L P[337] 240cm/min CNT100   ;
338: L P[338] 240cm/min CNT100   ;
339: L P[339] 240cm/min CNT100   ;
340: L P[340] 240cm/min CNT100   ;
341: L P[341] 240cm/min CNT100   ;
342: L P[342] 240cm/min CNT100   ;
343: L P[343] 240cm/min CNT100   ;
344: L P[344] 240cm/min CNT100   ;
345: L P[345] 240cm/min CNT100   ;
346: L P[346] 240cm/min CNT100   ;
347: L P[347] 240cm/min CNT100   ;
348: L P[348] 240cm/min CNT100   ;
349: L P[349] 240cm/min CNT100   ;
350: L P[350] 240cm/min CNT100   ;
351: L P[351] 240cm/min CNT100   ;
352: L P[352] 240cm/min CNT100   ;
353: L P[353] 240cm/min CNT100   ;
354: L P[354] 240cm/min CNT100   ;
355: L P[355] 240cm/min CNT100   ;
356: L P[356] 240cm/min CNT100   ;
357: L P[357] 240cm/min CNT100   ;
358: L P[358] 240cm/min CNT100   ;
359: L P[359] 240cm/min CNT100   ;
360: L P[360] 240cm/min CNT100   ;
361: L P[361] 240cm/min CNT100   ;
362: L P[362] 240cm/min CNT100   ;
363: L P[363] 240cm/min CNT100   ;
364: L P[364] 240cm/min CNT100   ;
365: L P[365] 240cm/min CNT100   ;
366: L P[366] 240cm/min CNT100   ;
367: L P[367] 240cm/min CNT100   ;
368: L P[368] 240cm/min CNT100   ;
369: L P[369] 240cm/min CNT100   ;
370: L P[370] 240cm/min CNT100   ;
371: L P[371] 240cm/min CNT100   ;
372: L P[372] 240cm/min CNT100   ;
373: L P[373] 240cm/min CNT100   ;
374: L P[374] 240cm/min CNT100   ;
375: L P[375] 240cm/min CNT100   ;
376: L P[376] 240cm/min CNT100   ;
377: L P[377] 240cm/min CNT100   ;
378: L P[378] 240cm/min CNT100   ;
379: L P[379] 240cm/min CNT100   ;
380: L P[380] 240cm/min CNT100   ;
381: L P[381] 240cm/min CNT100   ;
382: L P[382] 240cm/min CNT100   ;
383: L P[383] 240cm/min CNT100   ;
384: L P[384] 240cm/min CNT100   ;
385: L P[385] 240cm/min CNT100   ;
386: L P[386] 240cm/min CNT100   ;
387: L P[387] 240cm/min CNT100   ;
388: L P[388] 240cm/min CNT100   ;
389: L P[389] 240cm/min CNT100   ;
390: L P[390] 240cm/min CNT100   ;
391: L P[391] 240cm/min CNT100   ;
392: L P[392] 240cm/min CNT100   ;
393: L P[393] 240cm/min CNT100   ;
394: L P[394] 240cm/min CNT100   ;
395: L P[395] 240cm/min CNT100   ;
396: L P[396] 240cm/min CNT100   ;
397: L P[397] 240cm/min CNT100   ;
398: L P[398] 240cm/min CNT100   ;
399: L P[399] 240cm/min CNT100   ;
400: L P[400] 240cm/min CNT100   ;
: UFRAME_NUM=4;
401: J P[401] 40% FINE ;
402: L P[402] 500mm/sec CNT20 ;
403: LBL[1];
404: R[1]=R[1]+1;
405: L P[R[1]] 300mm/sec FINE ;
406: L PR[2] 300mm/sec FINE ;
407: L P[402] 500mm/sec CNT20 ;
408: IF R[1]<406,JMP LBL[1];
409: L P[407] 100mm/sec FINE INC;
: UFRAME_NUM=R[3];
410: L P[408] 100mm/sec FINE;
411: P[409]=LPOS ;
412: L P[409] 100mm/sec FINE;
413: UTOOL_NUM=3 ;
414: UFRAME_NUM=4 ;
415: J P[410] 40% FINE ;
416: ! end (P[1]);
/POS
P[1] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.425975 mm, Y = -224.575656 mm, Z = 612.322645 mm,
      W = -175.000000 deg, P = -5.000000 deg, R = -55.000000 deg
};
P[2] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.631126 mm, Y = -223.312158 mm, Z = 612.887295 mm,
      W = -175.002467 deg, P = -4.842946 deg, R = -54.842927 deg
};
P[3] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.796156 mm, Y = -222.035780 mm, Z = 613.446933 mm,
      W = -175.009866 deg, P = -4.686047 deg, R = -54.685892 deg
};
P[4] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.920458 mm, Y = -220.747800 mm, Z = 613.996591 mm,
      W = -175.022190 deg, P = -4.529458 deg, R = -54.528935 deg
};
P[5] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 383.003466 mm, Y = -219.449527 mm, Z = 614.531392 mm,
      W = -175.039426 deg, P = -4.373334 deg, R = -54.372095 deg
};
P[6] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 383.044658 mm, Y = -218.142289 mm, Z = 615.046588 mm,
      W = -175.061558 deg, P = -4.217828 deg, R = -54.215409 deg
};
P[7] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 383.043553 mm, Y = -216.827439 mm, Z = 615.537606 mm,
      W = -175.088564 deg, P = -4.063093 deg, R = -54.058917 deg
};
P[8] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.999714 mm, Y = -215.506351 mm, Z = 616.000087 mm,
      W = -175.120416 deg, P = -3.909284 deg, R = -53.902657 deg
};
P[9] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.912751 mm, Y = -214.180419 mm, Z = 616.429927 mm,
      W = -175.157084 deg, P = -3.756551 deg, R = -53.746668 deg
};
P[10] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.782317 mm, Y = -212.851055 mm, Z = 616.823311 mm,
      W = -175.198532 deg, P = -3.605044 deg, R = -53.590988 deg
};
P[11] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.608113 mm, Y = -211.519688 mm, Z = 617.176747 mm,
      W = -175.244717 deg, P = -3.454915 deg, R = -53.435655 deg
};
P[12] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.389885 mm, Y = -210.187763 mm, Z = 617.487097 mm,
      W = -175.295596 deg, P = -3.306310 deg, R = -53.280709 deg
};
P[13] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.127431 mm, Y = -208.856738 mm, Z = 617.751607 mm,
      W = -175.351118 deg, P = -3.159377 deg, R = -53.126187 deg
};
P[14] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 381.820592 mm, Y = -207.528083 mm, Z = 617.967929 mm,
      W = -175.411227 deg, P = -3.014261 deg, R = -52.972127 deg
};
P[15] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 381.469262 mm, Y = -206.203280 mm, Z = 618.134144 mm,
      W = -175.475865 deg, P = -2.871104 deg, R = -52.818568 deg
};
P[16] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 381.073383 mm, Y = -204.883818 mm, Z = 618.248775 mm,
      W = -175.544967 deg, P = -2.730048 deg, R = -52.665546 deg
};
P[17] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 380.632946 mm, Y = -203.571196 mm, Z = 618.310805 mm,
      W = -175.618467 deg, P = -2.591232 deg, R = -52.513101 deg
};
P[18] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 380.147994 mm, Y = -202.266916 mm, Z = 618.319684 mm,
      W = -175.696290 deg, P = -2.454793 deg, R = -52.361270 deg
};
P[19] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 379.618620 mm, Y = -200.972486 mm, Z = 618.275333 mm,
      W = -175.778360 deg, P = -2.320866 deg, R = -52.210089 deg
};
P[20] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 379.044967 mm, Y = -199.689415 mm, Z = 618.178145 mm,
      W = -175.864597 deg, P = -2.189583 deg, R = -52.059597 deg
};
P[21] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 378.427231 mm, Y = -198.419212 mm, Z = 618.028984 mm,
      W = -175.954915 deg, P = -2.061074 deg, R = -51.909830 deg
};
P[22] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 377.765658 mm, Y = -197.163388 mm, Z = 617.829173 mm,
      W = -176.049225 deg, P = -1.935465 deg, R = -51.760826 deg
};
P[23] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 377.060545 mm, Y = -195.923448 mm, Z = 617.580485 mm,
      W = -176.147434 deg, P = -1.812880 deg, R = -51.612621 deg
};
P[24] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 376.312242 mm, Y = -194.700893 mm, Z = 617.285128 mm,
      W = -176.249445 deg, P = -1.693441 deg, R = -51.465252 deg
};
P[25] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 375.521150 mm, Y = -193.497217 mm, Z = 616.945724 mm,
      W = -176.355157 deg, P = -1.577264 deg, R = -51.318754 deg
};
P[26] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 374.687722 mm, Y = -192.313909 mm, Z = 616.565285 mm,
      W = -176.464466 deg, P = -1.464466 deg, R = -51.173166 deg
};
P[27] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 373.812460 mm, Y = -191.152445 mm, Z = 616.147189 mm,
      W = -176.577264 deg, P = -1.355157 deg, R = -51.028521 deg
};
P[28] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 372.895919 mm, Y = -190.014289 mm, Z = 615.695145 mm,
      W = -176.693441 deg, P = -1.249445 deg, R = -50.884856 deg
};
P[29] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 371.938705 mm, Y = -188.900893 mm, Z = 615.213167 mm,
      W = -176.812880 deg, P = -1.147434 deg, R = -50.742207 deg
};
P[30] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 370.941475 mm, Y = -187.813694 mm, Z = 614.705532 mm,
      W = -176.935465 deg, P = -1.049225 deg, R = -50.600608 deg
};
P[31] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 369.904935 mm, Y = -186.754112 mm, Z = 614.176747 mm,
      W = -177.061074 deg, P = -0.954915 deg, R = -50.460095 deg
};
P[32] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 368.829841 mm, Y = -185.723546 mm, Z = 613.631504 mm,
      W = -177.189583 deg, P = -0.864597 deg, R = -50.320702 deg
};
P[33] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 367.716999 mm, Y = -184.723378 mm, Z = 613.074644 mm,
      W = -177.320866 deg, P = -0.778360 deg, R = -50.182463 deg
};
P[34] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 366.567264 mm, Y = -183.754965 mm, Z = 612.511109 mm,
      W = -177.454793 deg, P = -0.696290 deg, R = -50.045413 deg
};
P[35] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 365.381537 mm, Y = -182.819643 mm, Z = 611.945902 mm,
      W = -177.591232 deg, P = -0.618467 deg, R = -49.909586 deg
};
P[36] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 364.160770 mm, Y = -181.918719 mm, Z = 611.384038 mm,
      W = -177.730048 deg, P = -0.544967 deg, R = -49.775014 deg
};
P[37] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 362.905959 mm, Y = -181.053475 mm, Z = 610.830505 mm,
      W = -177.871104 deg, P = -0.475865 deg, R = -49.641732 deg
};
P[38] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 361.618147 mm, Y = -180.225164 mm, Z = 610.290217 mm,
      W = -178.014261 deg, P = -0.411227 deg, R = -49.509772 deg
};
P[39] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 360.298422 mm, Y = -179.435008 mm, Z = 609.767969 mm,
      W = -178.159377 deg, P = -0.351118 deg, R = -49.379166 deg
};
P[40] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 358.947917 mm, Y = -178.684197 mm, Z = 609.268396 mm,
      W = -178.306310 deg, P = -0.295596 deg, R = -49.249947 deg
};
P[41] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 357.567807 mm, Y = -177.973887 mm, Z = 608.795933 mm,
      W = -178.454915 deg, P = -0.244717 deg, R = -49.122147 deg
};
P[42] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 356.159312 mm, Y = -177.305199 mm, Z = 608.354774 mm,
      W = -178.605044 deg, P = -0.198532 deg, R = -48.995798 deg
};
P[43] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 354.723690 mm, Y = -176.679219 mm, Z = 607.948833 mm,
      W = -178.756551 deg, P = -0.157084 deg, R = -48.870929 deg
};
P[44] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 353.262240 mm, Y = -176.096991 mm, Z = 607.581715 mm,
      W = -178.909284 deg, P = -0.120416 deg, R = -48.747573 deg
};
P[45] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 351.776302 mm, Y = -175.559522 mm, Z = 607.256677 mm,
      W = -179.063093 deg, P = -0.088564 deg, R = -48.625760 deg
};
P[46] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 350.267252 mm, Y = -175.067778 mm, Z = 606.976606 mm,
      W = -179.217828 deg, P = -0.061558 deg, R = -48.505520 deg
};
P[47] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 348.736503 mm, Y = -174.622681 mm, Z = 606.743986 mm,
      W = -179.373334 deg, P = -0.039426 deg, R = -48.386881 deg
};
P[48] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 347.185503 mm, Y = -174.225110 mm, Z = 606.560883 mm,
      W = -179.529458 deg, P = -0.022190 deg, R = -48.269875 deg
};
P[49] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 345.615733 mm, Y = -173.875898 mm, Z = 606.428921 mm,
      W = -179.686047 deg, P = -0.009866 deg, R = -48.154529 deg
};
P[50] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 344.028709 mm, Y = -173.575834 mm, Z = 606.349273 mm,
      W = -179.842946 deg, P = -0.002467 deg, R = -48.040872 deg
};
P[51] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 342.425975 mm, Y = -173.325656 mm, Z = 606.322645 mm,
      W = -180.000000 deg, P = -0.000000 deg, R = -47.928932 deg
};
P[52] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 340.809106 mm, Y = -173.126056 mm, Z = 606.349273 mm,
      W = -180.157054 deg, P = -0.002467 deg, R = -47.818737 deg
};
P[53] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 339.179705 mm, Y = -172.977674 mm, Z = 606.428921 mm,
      W = -180.313953 deg, P = -0.009866 deg, R = -47.710314 deg
};
P[54] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 337.539401 mm, Y = -172.881101 mm, Z = 606.560883 mm,
      W = -180.470542 deg, P = -0.022190 deg, R = -47.603689 deg
};
P[55] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 335.889847 mm, Y = -172.836874 mm, Z = 606.743986 mm,
      W = -180.626666 deg, P = -0.039426 deg, R = -47.498889 deg
};
P[56] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 334.232720 mm, Y = -172.845479 mm, Z = 606.976606 mm,
      W = -180.782172 deg, P = -0.061558 deg, R = -47.395940 deg
};
P[57] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 332.569718 mm, Y = -172.907347 mm, Z = 607.256677 mm,
      W = -180.936907 deg, P = -0.088564 deg, R = -47.294868 deg
};
P[58] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 330.902558 mm, Y = -173.022853 mm, Z = 607.581715 mm,
      W = -181.090716 deg, P = -0.120416 deg, R = -47.195696 deg
};
P[59] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 329.232976 mm, Y = -173.192319 mm, Z = 607.948833 mm,
      W = -181.243449 deg, P = -0.157084 deg, R = -47.098450 deg
};
P[60] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 327.562724 mm, Y = -173.416010 mm, Z = 608.354774 mm,
      W = -181.394956 deg, P = -0.198532 deg, R = -47.003153 deg
};
P[61] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 325.893566 mm, Y = -173.694132 mm, Z = 608.795933 mm,
      W = -181.545085 deg, P = -0.244717 deg, R = -46.909830 deg
};
P[62] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 324.227280 mm, Y = -174.026837 mm, Z = 609.268396 mm,
      W = -181.693690 deg, P = -0.295596 deg, R = -46.818503 deg
};
P[63] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 322.565655 mm, Y = -174.414215 mm, Z = 609.767969 mm,
      W = -181.840623 deg, P = -0.351118 deg, R = -46.729194 deg
};
P[64] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 320.910488 mm, Y = -174.856299 mm, Z = 610.290217 mm,
      W = -181.985739 deg, P = -0.411227 deg, R = -46.641926 deg
};
P[65] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 319.263581 mm, Y = -175.353064 mm, Z = 610.830505 mm,
      W = -182.128896 deg, P = -0.475865 deg, R = -46.556721 deg
};
P[66] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 317.626744 mm, Y = -175.904425 mm, Z = 611.384038 mm,
      W = -182.269952 deg, P = -0.544967 deg, R = -46.473598 deg
};
P[67] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 316.001786 mm, Y = -176.510235 mm, Z = 611.945902 mm,
      W = -182.408768 deg, P = -0.618467 deg, R = -46.392580 deg
};
P[68] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 314.390519 mm, Y = -177.170289 mm, Z = 612.511109 mm,
      W = -182.545207 deg, P = -0.696290 deg, R = -46.313685 deg
};
P[69] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 312.794753 mm, Y = -177.884322 mm, Z = 613.074644 mm,
      W = -182.679134 deg, P = -0.778360 deg, R = -46.236933 deg
};
P[70] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 311.216295 mm, Y = -178.652007 mm, Z = 613.631504 mm,
      W = -182.810417 deg, P = -0.864597 deg, R = -46.162344 deg
};
P[71] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 309.656947 mm, Y = -179.472959 mm, Z = 614.176747 mm,
      W = -182.938926 deg, P = -0.954915 deg, R = -46.089935 deg
};
P[72] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 308.118502 mm, Y = -180.346729 mm, Z = 614.705532 mm,
      W = -183.064535 deg, P = -1.049225 deg, R = -46.019724 deg
};
P[73] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 306.602747 mm, Y = -181.272812 mm, Z = 615.213167 mm,
      W = -183.187120 deg, P = -1.147434 deg, R = -45.951729 deg
};
P[74] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 305.111453 mm, Y = -182.250639 mm, Z = 615.695145 mm,
      W = -183.306559 deg, P = -1.249445 deg, R = -45.885967 deg
};
P[75] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 303.646381 mm, Y = -183.279583 mm, Z = 616.147189 mm,
      W = -183.422736 deg, P = -1.355157 deg, R = -45.822454 deg
};
P[76] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 302.209277 mm, Y = -184.358958 mm, Z = 616.565285 mm,
      W = -183.535534 deg, P = -1.464466 deg, R = -45.761205 deg
};
P[77] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 300.801866 mm, Y = -185.488016 mm, Z = 616.945724 mm,
      W = -183.644843 deg, P = -1.577264 deg, R = -45.702235 deg
};
P[78] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 299.425858 mm, Y = -186.665953 mm, Z = 617.285128 mm,
      W = -183.750555 deg, P = -1.693441 deg, R = -45.645560 deg
};
P[79] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 298.082938 mm, Y = -187.891905 mm, Z = 617.580485 mm,
      W = -183.852566 deg, P = -1.812880 deg, R = -45.591192 deg
};
P[80] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 296.774769 mm, Y = -189.164951 mm, Z = 617.829173 mm,
      W = -183.950775 deg, P = -1.935465 deg, R = -45.539146 deg
};
P[81] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 295.502989 mm, Y = -190.484111 mm, Z = 618.028984 mm,
      W = -184.045085 deg, P = -2.061074 deg, R = -45.489435 deg
};
P[82] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 294.269208 mm, Y = -191.848351 mm, Z = 618.178145 mm,
      W = -184.135403 deg, P = -2.189583 deg, R = -45.442070 deg
};
P[83] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 293.075008 mm, Y = -193.256580 mm, Z = 618.275333 mm,
      W = -184.221640 deg, P = -2.320866 deg, R = -45.397063 deg
};
P[84] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 291.921936 mm, Y = -194.707651 mm, Z = 618.319684 mm,
      W = -184.303710 deg, P = -2.454793 deg, R = -45.354426 deg
};
P[85] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 290.811511 mm, Y = -196.200365 mm, Z = 618.310805 mm,
      W = -184.381533 deg, P = -2.591232 deg, R = -45.314168 deg
};
P[86] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 289.745214 mm, Y = -197.733468 mm, Z = 618.248775 mm,
      W = -184.455033 deg, P = -2.730048 deg, R = -45.276301 deg
};
P[87] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 288.724489 mm, Y = -199.305655 mm, Z = 618.134144 mm,
      W = -184.524135 deg, P = -2.871104 deg, R = -45.240832 deg
};
P[88] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 287.750743 mm, Y = -200.915571 mm, Z = 617.967929 mm,
      W = -184.588773 deg, P = -3.014261 deg, R = -45.207772 deg
};
P[89] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 286.825341 mm, Y = -202.561808 mm, Z = 617.751607 mm,
      W = -184.648882 deg, P = -3.159377 deg, R = -45.177127 deg
};
P[90] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 285.949607 mm, Y = -204.242912 mm, Z = 617.487097 mm,
      W = -184.704404 deg, P = -3.306310 deg, R = -45.148907 deg
};
P[91] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 285.124820 mm, Y = -205.957382 mm, Z = 617.176747 mm,
      W = -184.755283 deg, P = -3.454915 deg, R = -45.123117 deg
};
P[92] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 284.352214 mm, Y = -207.703669 mm, Z = 616.823311 mm,
      W = -184.801468 deg, P = -3.605044 deg, R = -45.099763 deg
};
P[93] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 283.632977 mm, Y = -209.480180 mm, Z = 616.429927 mm,
      W = -184.842916 deg, P = -3.756551 deg, R = -45.078853 deg
};
P[94] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 282.968246 mm, Y = -211.285279 mm, Z = 616.000087 mm,
      W = -184.879584 deg, P = -3.909284 deg, R = -45.060390 deg
};
P[95] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 282.359109 mm, Y = -213.117289 mm, Z = 615.537606 mm,
      W = -184.911436 deg, P = -4.063093 deg, R = -45.044380 deg
};
P[96] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 281.806603 mm, Y = -214.974491 mm, Z = 615.046588 mm,
      W = -184.938442 deg, P = -4.217828 deg, R = -45.030827 deg
};
P[97] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 281.311709 mm, Y = -216.855129 mm, Z = 614.531392 mm,
      W = -184.960574 deg, P = -4.373334 deg, R = -45.019733 deg
};
P[98] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.875356 mm, Y = -218.757410 mm, Z = 613.996591 mm,
      W = -184.977810 deg, P = -4.529458 deg, R = -45.011101 deg
};
P[99] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.498416 mm, Y = -220.679504 mm, Z = 613.446933 mm,
      W = -184.990134 deg, P = -4.686047 deg, R = -45.004934 deg
};
P[100] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.181704 mm, Y = -222.619551 mm, Z = 612.887295 mm,
      W = -184.997533 deg, P = -4.842946 deg, R = -45.001234 deg
};
P[101] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.925975 mm, Y = -224.575656 mm, Z = 612.322645 mm,
      W = -185.000000 deg, P = -5.000000 deg, R = -45.000000 deg
};
P[102] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.731926 mm, Y = -226.545896 mm, Z = 611.757995 mm,
      W = -184.997533 deg, P = -5.157054 deg, R = -45.001234 deg
};
P[103] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.600192 mm, Y = -228.528319 mm, Z = 611.198357 mm,
      W = -184.990134 deg, P = -5.313953 deg, R = -45.004934 deg
};
P[104] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.531348 mm, Y = -230.520949 mm, Z = 610.648698 mm,
      W = -184.977810 deg, P = -5.470542 deg, R = -45.011101 deg
};
P[105] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.525903 mm, Y = -232.521783 mm, Z = 610.113897 mm,
      W = -184.960574 deg, P = -5.626666 deg, R = -45.019733 deg
};
P[106] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.584304 mm, Y = -234.528799 mm, Z = 609.598702 mm,
      W = -184.938442 deg, P = -5.782172 deg, R = -45.030827 deg
};
P[107] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.706934 mm, Y = -236.539953 mm, Z = 609.107684 mm,
      W = -184.911436 deg, P = -5.936907 deg, R = -45.044380 deg
};
P[108] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 279.894108 mm, Y = -238.553184 mm, Z = 608.645202 mm,
      W = -184.879584 deg, P = -6.090716 deg, R = -45.060390 deg
};
P[109] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.146078 mm, Y = -240.566416 mm, Z = 608.215362 mm,
      W = -184.842916 deg, P = -6.243449 deg, R = -45.078853 deg
};
P[110] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.463025 mm, Y = -242.577557 mm, Z = 607.821978 mm,
      W = -184.801468 deg, P = -6.394956 deg, R = -45.099763 deg
};
P[111] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.845065 mm, Y = -244.584506 mm, Z = 607.468543 mm,
      W = -184.755283 deg, P = -6.545085 deg, R = -45.123117 deg
};
P[112] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 281.292247 mm, Y = -246.585152 mm, Z = 607.158193 mm,
      W = -184.704404 deg, P = -6.693690 deg, R = -45.148907 deg
};
P[113] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 281.804548 mm, Y = -248.577377 mm, Z = 606.893682 mm,
      W = -184.648882 deg, P = -6.840623 deg, R = -45.177127 deg
};
P[114] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 282.381878 mm, Y = -250.559057 mm, Z = 606.677360 mm,
      W = -184.588773 deg, P = -6.985739 deg, R = -45.207772 deg
};
P[115] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 283.024079 mm, Y = -252.528067 mm, Z = 606.511146 mm,
      W = -184.524135 deg, P = -7.128896 deg, R = -45.240832 deg
};
P[116] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 283.730920 mm, Y = -254.482280 mm, Z = 606.396515 mm,
      W = -184.455033 deg, P = -7.269952 deg, R = -45.276301 deg
};
P[117] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 284.502103 mm, Y = -256.419574 mm, Z = 606.334484 mm,
      W = -184.381533 deg, P = -7.408768 deg, R = -45.314168 deg
};
P[118] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 285.337260 mm, Y = -258.337828 mm, Z = 606.325605 mm,
      W = -184.303710 deg, P = -7.545207 deg, R = -45.354426 deg
};
P[119] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 286.235951 mm, Y = -260.234929 mm, Z = 606.369957 mm,
      W = -184.221640 deg, P = -7.679134 deg, R = -45.397063 deg
};
P[120] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 287.197669 mm, Y = -262.108774 mm, Z = 606.467144 mm,
      W = -184.135403 deg, P = -7.810417 deg, R = -45.442070 deg
};
P[121] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 288.221836 mm, Y = -263.957268 mm, Z = 606.616306 mm,
      W = -184.045085 deg, P = -7.938926 deg, R = -45.489435 deg
};
P[122] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 289.307804 mm, Y = -265.778333 mm, Z = 606.816117 mm,
      W = -183.950775 deg, P = -8.064535 deg, R = -45.539146 deg
};
P[123] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 290.454857 mm, Y = -267.569904 mm, Z = 607.064805 mm,
      W = -183.852566 deg, P = -8.187120 deg, R = -45.591192 deg
};
P[124] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 291.662208 mm, Y = -269.329937 mm, Z = 607.360161 mm,
      W = -183.750555 deg, P = -8.306559 deg, R = -45.645560 deg
};
P[125] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 292.929005 mm, Y = -271.056405 mm, Z = 607.699565 mm,
      W = -183.644843 deg, P = -8.422736 deg, R = -45.702235 deg
};
P[126] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 294.254325 mm, Y = -272.747306 mm, Z = 608.080004 mm,
      W = -183.535534 deg, P = -8.535534 deg, R = -45.761205 deg
};
P[127] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 295.637180 mm, Y = -274.400662 mm, Z = 608.498101 mm,
      W = -183.422736 deg, P = -8.644843 deg, R = -45.822454 deg
};
P[128] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 297.076514 mm, Y = -276.014523 mm, Z = 608.950144 mm,
      W = -183.306559 deg, P = -8.750555 deg, R = -45.885967 deg
};
P[129] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 298.571204 mm, Y = -277.586967 mm, Z = 609.432123 mm,
      W = -183.187120 deg, P = -8.852566 deg, R = -45.951729 deg
};
P[130] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 300.120065 mm, Y = -279.116106 mm, Z = 609.939757 mm,
      W = -183.064535 deg, P = -8.950775 deg, R = -46.019724 deg
};
P[131] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 301.721846 mm, Y = -280.600083 mm, Z = 610.468543 mm,
      W = -182.938926 deg, P = -9.045085 deg, R = -46.089935 deg
};
P[132] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 303.375232 mm, Y = -282.037079 mm, Z = 611.013785 mm,
      W = -182.810417 deg, P = -9.135403 deg, R = -46.162344 deg
};
P[133] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 305.078847 mm, Y = -283.425312 mm, Z = 611.570645 mm,
      W = -182.679134 deg, P = -9.221640 deg, R = -46.236933 deg
};
P[134] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 306.831254 mm, Y = -284.763042 mm, Z = 612.134180 mm,
      W = -182.545207 deg, P = -9.303710 deg, R = -46.313685 deg
};
P[135] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 308.630955 mm, Y = -286.048570 mm, Z = 612.699388 mm,
      W = -182.408768 deg, P = -9.381533 deg, R = -46.392580 deg
};
P[136] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 310.476393 mm, Y = -287.280240 mm, Z = 613.261252 mm,
      W = -182.269952 deg, P = -9.455033 deg, R = -46.473598 deg
};
P[137] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 312.365957 mm, Y = -288.456446 mm, Z = 613.814784 mm,
      W = -182.128896 deg, P = -9.524135 deg, R = -46.556721 deg
};
P[138] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 314.297975 mm, Y = -289.575627 mm, Z = 614.355072 mm,
      W = -181.985739 deg, P = -9.588773 deg, R = -46.641926 deg
};
P[139] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 316.270725 mm, Y = -290.636275 mm, Z = 614.877321 mm,
      W = -181.840623 deg, P = -9.648882 deg, R = -46.729194 deg
};
P[140] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 318.282430 mm, Y = -291.636933 mm, Z = 615.376893 mm,
      W = -181.693690 deg, P = -9.704404 deg, R = -46.818503 deg
};
P[141] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 320.331260 mm, Y = -292.576197 mm, Z = 615.849356 mm,
      W = -181.545085 deg, P = -9.755283 deg, R = -46.909830 deg
};
P[142] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 322.415338 mm, Y = -293.452721 mm, Z = 616.290516 mm,
      W = -181.394956 deg, P = -9.801468 deg, R = -47.003153 deg
};
P[143] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 324.532737 mm, Y = -294.265215 mm, Z = 616.696457 mm,
      W = -181.243449 deg, P = -9.842916 deg, R = -47.098450 deg
};
P[144] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 326.681486 mm, Y = -295.012448 mm, Z = 617.063575 mm,
      W = -181.090716 deg, P = -9.879584 deg, R = -47.195696 deg
};
P[145] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 328.859568 mm, Y = -295.693253 mm, Z = 617.388612 mm,
      W = -180.936907 deg, P = -9.911436 deg, R = -47.294868 deg
};
P[146] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 331.064922 mm, Y = -296.306522 mm, Z = 617.668684 mm,
      W = -180.782172 deg, P = -9.938442 deg, R = -47.395940 deg
};
P[147] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 333.295449 mm, Y = -296.851212 mm, Z = 617.901304 mm,
      W = -180.626666 deg, P = -9.960574 deg, R = -47.498889 deg
};
P[148] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 335.549010 mm, Y = -297.326347 mm, Z = 618.084407 mm,
      W = -180.470542 deg, P = -9.977810 deg, R = -47.603689 deg
};
P[149] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 337.823430 mm, Y = -297.731015 mm, Z = 618.216368 mm,
      W = -180.313953 deg, P = -9.990134 deg, R = -47.710314 deg
};
P[150] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 340.116499 mm, Y = -298.064376 mm, Z = 618.296017 mm,
      W = -180.157054 deg, P = -9.997533 deg, R = -47.818737 deg
};
P[151] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 342.425975 mm, Y = -298.325656 mm, Z = 618.322645 mm,
      W = -180.000000 deg, P = -10.000000 deg, R = -47.928932 deg
};
P[152] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 344.749586 mm, Y = -298.514154 mm, Z = 618.296017 mm,
      W = -179.842946 deg, P = -9.997533 deg, R = -48.040872 deg
};
P[153] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 347.085031 mm, Y = -298.629239 mm, Z = 618.216368 mm,
      W = -179.686047 deg, P = -9.990134 deg, R = -48.154529 deg
};
P[154] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 349.429986 mm, Y = -298.670355 mm, Z = 618.084407 mm,
      W = -179.529458 deg, P = -9.977810 deg, R = -48.269875 deg
};
P[155] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 351.782101 mm, Y = -298.637019 mm, Z = 617.901304 mm,
      W = -179.373334 deg, P = -9.960574 deg, R = -48.386881 deg
};
P[156] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 354.139005 mm, Y = -298.528821 mm, Z = 617.668684 mm,
      W = -179.217828 deg, P = -9.938442 deg, R = -48.505520 deg
};
P[157] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 356.498311 mm, Y = -298.345429 mm, Z = 617.388612 mm,
      W = -179.063093 deg, P = -9.911436 deg, R = -48.625760 deg
};
P[158] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 358.857614 mm, Y = -298.086586 mm, Z = 617.063575 mm,
      W = -178.909284 deg, P = -9.879584 deg, R = -48.747573 deg
};
P[159] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 361.214496 mm, Y = -297.752114 mm, Z = 616.696457 mm,
      W = -178.756551 deg, P = -9.842916 deg, R = -48.870929 deg
};
P[160] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 363.566526 mm, Y = -297.341910 mm, Z = 616.290516 mm,
      W = -178.605044 deg, P = -9.801468 deg, R = -48.995798 deg
};
P[161] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 365.911266 mm, Y = -296.855951 mm, Z = 615.849356 mm,
      W = -178.454915 deg, P = -9.755283 deg, R = -49.122147 deg
};
P[162] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 368.246273 mm, Y = -296.294293 mm, Z = 615.376893 mm,
      W = -178.306310 deg, P = -9.704404 deg, R = -49.249947 deg
};
P[163] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 370.569097 mm, Y = -295.657068 mm, Z = 614.877321 mm,
      W = -178.159377 deg, P = -9.648882 deg, R = -49.379166 deg
};
P[164] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 372.877289 mm, Y = -294.944492 mm, Z = 614.355072 mm,
      W = -178.014261 deg, P = -9.588773 deg, R = -49.509772 deg
};
P[165] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 375.168402 mm, Y = -294.156856 mm, Z = 613.814784 mm,
      W = -177.871104 deg, P = -9.524135 deg, R = -49.641732 deg
};
P[166] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 377.439992 mm, Y = -293.294534 mm, Z = 613.261252 mm,
      W = -177.730048 deg, P = -9.455033 deg, R = -49.775014 deg
};
P[167] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 379.689621 mm, Y = -292.357978 mm, Z = 612.699388 mm,
      W = -177.591232 deg, P = -9.381533 deg, R = -49.909586 deg
};
P[168] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 381.914863 mm, Y = -291.347719 mm, Z = 612.134180 mm,
      W = -177.454793 deg, P = -9.303710 deg, R = -50.045413 deg
};
P[169] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 384.113299 mm, Y = -290.264369 mm, Z = 611.570645 mm,
      W = -177.320866 deg, P = -9.221640 deg, R = -50.182463 deg
};
P[170] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 386.282530 mm, Y = -289.108618 mm, Z = 611.013785 mm,
      W = -177.189583 deg, P = -9.135403 deg, R = -50.320702 deg
};
P[171] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 388.420171 mm, Y = -287.881236 mm, Z = 610.468543 mm,
      W = -177.061074 deg, P = -9.045085 deg, R = -50.460095 deg
};
P[172] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 390.523856 mm, Y = -286.583071 mm, Z = 609.939757 mm,
      W = -176.935465 deg, P = -8.950775 deg, R = -50.600608 deg
};
P[173] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 392.591243 mm, Y = -285.215048 mm, Z = 609.432123 mm,
      W = -176.812880 deg, P = -8.852566 deg, R = -50.742207 deg
};
P[174] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 394.620014 mm, Y = -283.778172 mm, Z = 608.950144 mm,
      W = -176.693441 deg, P = -8.750555 deg, R = -50.884856 deg
};
P[175] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 396.607878 mm, Y = -282.273523 mm, Z = 608.498101 mm,
      W = -176.577264 deg, P = -8.644843 deg, R = -51.028521 deg
};
P[176] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 398.552576 mm, Y = -280.702257 mm, Z = 608.080004 mm,
      W = -176.464466 deg, P = -8.535534 deg, R = -51.173166 deg
};
P[177] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 400.451878 mm, Y = -279.065606 mm, Z = 607.699565 mm,
      W = -176.355157 deg, P = -8.422736 deg, R = -51.318754 deg
};
P[178] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 402.303591 mm, Y = -277.364876 mm, Z = 607.360161 mm,
      W = -176.249445 deg, P = -8.306559 deg, R = -51.465252 deg
};
P[179] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 404.105560 mm, Y = -275.601446 mm, Z = 607.064805 mm,
      W = -176.147434 deg, P = -8.187120 deg, R = -51.612621 deg
};
P[180] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 405.855668 mm, Y = -273.776770 mm, Z = 606.816117 mm,
      W = -176.049225 deg, P = -8.064535 deg, R = -51.760826 deg
};
P[181] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 407.551843 mm, Y = -271.892369 mm, Z = 606.616306 mm,
      W = -175.954915 deg, P = -7.938926 deg, R = -51.909830 deg
};
P[182] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 409.192054 mm, Y = -269.949837 mm, Z = 606.467144 mm,
      W = -175.864597 deg, P = -7.810417 deg, R = -52.059597 deg
};
P[183] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 410.774320 mm, Y = -267.950835 mm, Z = 606.369957 mm,
      W = -175.778360 deg, P = -7.679134 deg, R = -52.210089 deg
};
P[184] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 412.296709 mm, Y = -265.897093 mm, Z = 606.325605 mm,
      W = -175.696290 deg, P = -7.545207 deg, R = -52.361270 deg
};
P[185] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 413.757339 mm, Y = -263.790405 mm, Z = 606.334484 mm,
      W = -175.618467 deg, P = -7.408768 deg, R = -52.513101 deg
};
P[186] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 415.154382 mm, Y = -261.632631 mm, Z = 606.396515 mm,
      W = -175.544967 deg, P = -7.269952 deg, R = -52.665546 deg
};
P[187] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 416.486069 mm, Y = -259.425691 mm, Z = 606.511146 mm,
      W = -175.475865 deg, P = -7.128896 deg, R = -52.818568 deg
};
P[188] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 417.750686 mm, Y = -257.171569 mm, Z = 606.677360 mm,
      W = -175.411227 deg, P = -6.985739 deg, R = -52.972127 deg
};
P[189] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 418.946580 mm, Y = -254.872307 mm, Z = 606.893682 mm,
      W = -175.351118 deg, P = -6.840623 deg, R = -53.126187 deg
};
P[190] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 420.072160 mm, Y = -252.530003 mm, Z = 607.158193 mm,
      W = -175.295596 deg, P = -6.693690 deg, R = -53.280709 deg
};
P[191] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 421.125901 mm, Y = -250.146812 mm, Z = 607.468543 mm,
      W = -175.244717 deg, P = -6.545085 deg, R = -53.435655 deg
};
P[192] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 422.106343 mm, Y = -247.724943 mm, Z = 607.821978 mm,
      W = -175.198532 deg, P = -6.394956 deg, R = -53.590988 deg
};
P[193] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 423.012094 mm, Y = -245.266655 mm, Z = 608.215362 mm,
      W = -175.157084 deg, P = -6.243449 deg, R = -53.746668 deg
};
P[194] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 423.841831 mm, Y = -242.774256 mm, Z = 608.645202 mm,
      W = -175.120416 deg, P = -6.090716 deg, R = -53.902657 deg
};
P[195] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 424.594303 mm, Y = -240.250103 mm, Z = 609.107684 mm,
      W = -175.088564 deg, P = -5.936907 deg, R = -54.058917 deg
};
P[196] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 425.268334 mm, Y = -237.696597 mm, Z = 609.598702 mm,
      W = -175.061558 deg, P = -5.782172 deg, R = -54.215409 deg
};
P[197] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 425.862821 mm, Y = -235.116181 mm, Z = 610.113897 mm,
      W = -175.039426 deg, P = -5.626666 deg, R = -54.372095 deg
};
P[198] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 426.376737 mm, Y = -232.511340 mm, Z = 610.648698 mm,
      W = -175.022190 deg, P = -5.470542 deg, R = -54.528935 deg
};
P[199] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 426.809135 mm, Y = -229.884595 mm, Z = 611.198357 mm,
      W = -175.009866 deg, P = -5.313953 deg, R = -54.685892 deg
};
P[200] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.159143 mm, Y = -227.238503 mm, Z = 611.757995 mm,
      W = -175.002467 deg, P = -5.157054 deg, R = -54.842927 deg
};
P[201] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.425975 mm, Y = -224.575656 mm, Z = 612.322645 mm,
      W = -175.000000 deg, P = -5.000000 deg, R = -55.000000 deg
};
P[202] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.608921 mm, Y = -221.898674 mm, Z = 612.887295 mm,
      W = -175.002467 deg, P = -4.842946 deg, R = -55.157073 deg
};
P[203] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.707359 mm, Y = -219.210206 mm, Z = 613.446933 mm,
      W = -175.009866 deg, P = -4.686047 deg, R = -55.314108 deg
};
P[204] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.720746 mm, Y = -216.512926 mm, Z = 613.996591 mm,
      W = -175.022190 deg, P = -4.529458 deg, R = -55.471065 deg
};
P[205] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.648628 mm, Y = -213.809531 mm, Z = 614.531392 mm,
      W = -175.039426 deg, P = -4.373334 deg, R = -55.627905 deg
};
P[206] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.490633 mm, Y = -211.102738 mm, Z = 615.046588 mm,
      W = -175.061558 deg, P = -4.217828 deg, R = -55.784591 deg
};
P[207] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.246479 mm, Y = -208.395280 mm, Z = 615.537606 mm,
      W = -175.088564 deg, P = -4.063093 deg, R = -55.941083 deg
};
P[208] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 426.915968 mm, Y = -205.689905 mm, Z = 616.000087 mm,
      W = -175.120416 deg, P = -3.909284 deg, R = -56.097343 deg
};
P[209] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 426.498993 mm, Y = -202.989374 mm, Z = 616.429927 mm,
      W = -175.157084 deg, P = -3.756551 deg, R = -56.253332 deg
};
P[210] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 425.995533 mm, Y = -200.296455 mm, Z = 616.823311 mm,
      W = -175.198532 deg, P = -3.605044 deg, R = -56.409012 deg
};
P[211] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 425.405656 mm, Y = -197.613923 mm, Z = 617.176747 mm,
      W = -175.244717 deg, P = -3.454915 deg, R = -56.564345 deg
};
P[212] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 424.729520 mm, Y = -194.944557 mm, Z = 617.487097 mm,
      W = -175.295596 deg, P = -3.306310 deg, R = -56.719291 deg
};
P[213] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 423.967373 mm, Y = -192.291133 mm, Z = 617.751607 mm,
      W = -175.351118 deg, P = -3.159377 deg, R = -56.873813 deg
};
P[214] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 423.119550 mm, Y = -189.656428 mm, Z = 617.967929 mm,
      W = -175.411227 deg, P = -3.014261 deg, R = -57.027873 deg
};
P[215] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 422.186479 mm, Y = -187.043212 mm, Z = 618.134144 mm,
      W = -175.475865 deg, P = -2.871104 deg, R = -57.181432 deg
};
P[216] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 421.168676 mm, Y = -184.454246 mm, Z = 618.248775 mm,
      W = -175.544967 deg, P = -2.730048 deg, R = -57.334454 deg
};
P[217] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 420.066747 mm, Y = -181.892281 mm, Z = 618.310805 mm,
      W = -175.618467 deg, P = -2.591232 deg, R = -57.486899 deg
};
P[218] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 418.881385 mm, Y = -179.360052 mm, Z = 618.319684 mm,
      W = -175.696290 deg, P = -2.454793 deg, R = -57.638730 deg
};
P[219] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 417.613377 mm, Y = -176.860280 mm, Z = 618.275333 mm,
      W = -175.778360 deg, P = -2.320866 deg, R = -57.789911 deg
};
P[220] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 416.263593 mm, Y = -174.395663 mm, Z = 618.178145 mm,
      W = -175.864597 deg, P = -2.189583 deg, R = -57.940403 deg
};
P[221] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 414.832996 mm, Y = -171.968876 mm, Z = 618.028984 mm,
      W = -175.954915 deg, P = -2.061074 deg, R = -58.090170 deg
};
P[222] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 413.322633 mm, Y = -169.582571 mm, Z = 617.829173 mm,
      W = -176.049225 deg, P = -1.935465 deg, R = -58.239174 deg
};
P[223] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 411.733641 mm, Y = -167.239368 mm, Z = 617.580485 mm,
      W = -176.147434 deg, P = -1.812880 deg, R = -58.387379 deg
};
P[224] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 410.067240 mm, Y = -164.941859 mm, Z = 617.285128 mm,
      W = -176.249445 deg, P = -1.693441 deg, R = -58.534748 deg
};
P[225] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 408.324739 mm, Y = -162.692598 mm, Z = 616.945724 mm,
      W = -176.355157 deg, P = -1.577264 deg, R = -58.681246 deg
};
P[226] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 406.507527 mm, Y = -160.494104 mm, Z = 616.565285 mm,
      W = -176.464466 deg, P = -1.464466 deg, R = -58.826834 deg
};
P[227] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 404.617079 mm, Y = -158.348856 mm, Z = 616.147189 mm,
      W = -176.577264 deg, P = -1.355157 deg, R = -58.971479 deg
};
P[228] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 402.654953 mm, Y = -156.259290 mm, Z = 615.695145 mm,
      W = -176.693441 deg, P = -1.249445 deg, R = -59.115144 deg
};
P[229] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 400.622785 mm, Y = -154.227797 mm, Z = 615.213167 mm,
      W = -176.812880 deg, P = -1.147434 deg, R = -59.257793 deg
};
P[230] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 398.522293 mm, Y = -152.256719 mm, Z = 614.705532 mm,
      W = -176.935465 deg, P = -1.049225 deg, R = -59.399392 deg
};
P[231] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 396.355272 mm, Y = -150.348347 mm, Z = 614.176747 mm,
      W = -177.061074 deg, P = -0.954915 deg, R = -59.539905 deg
};
P[232] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 394.123593 mm, Y = -148.504920 mm, Z = 613.631504 mm,
      W = -177.189583 deg, P = -0.864597 deg, R = -59.679298 deg
};
P[233] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 391.829205 mm, Y = -146.728621 mm, Z = 613.074644 mm,
      W = -177.320866 deg, P = -0.778360 deg, R = -59.817537 deg
};
P[234] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 389.474128 mm, Y = -145.021574 mm, Z = 612.511109 mm,
      W = -177.454793 deg, P = -0.696290 deg, R = -59.954587 deg
};
P[235] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 387.060453 mm, Y = -143.385842 mm, Z = 611.945902 mm,
      W = -177.591232 deg, P = -0.618467 deg, R = -60.090414 deg
};
P[236] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 384.590342 mm, Y = -141.823425 mm, Z = 611.384038 mm,
      W = -177.730048 deg, P = -0.544967 deg, R = -60.224986 deg
};
P[237] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 382.066027 mm, Y = -140.336258 mm, Z = 610.830505 mm,
      W = -177.871104 deg, P = -0.475865 deg, R = -60.358268 deg
};
P[238] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 379.489802 mm, Y = -138.926206 mm, Z = 610.290217 mm,
      W = -178.014261 deg, P = -0.411227 deg, R = -60.490228 deg
};
P[239] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 376.864027 mm, Y = -137.595066 mm, Z = 609.767969 mm,
      W = -178.159377 deg, P = -0.351118 deg, R = -60.620834 deg
};
P[240] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 374.191123 mm, Y = -136.344562 mm, Z = 609.268396 mm,
      W = -178.306310 deg, P = -0.295596 deg, R = -60.750053 deg
};
P[241] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 371.473572 mm, Y = -135.176344 mm, Z = 608.795933 mm,
      W = -178.454915 deg, P = -0.244717 deg, R = -60.877853 deg
};
P[242] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 368.713912 mm, Y = -134.091984 mm, Z = 608.354774 mm,
      W = -178.605044 deg, P = -0.198532 deg, R = -61.004202 deg
};
P[243] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 365.914735 mm, Y = -133.092977 mm, Z = 607.948833 mm,
      W = -178.756551 deg, P = -0.157084 deg, R = -61.129071 deg
};
P[244] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 363.078686 mm, Y = -132.180737 mm, Z = 607.581715 mm,
      W = -178.909284 deg, P = -0.120416 deg, R = -61.252427 deg
};
P[245] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 360.208462 mm, Y = -131.356596 mm, Z = 607.256677 mm,
      W = -179.063093 deg, P = -0.088564 deg, R = -61.374240 deg
};
P[246] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 357.306803 mm, Y = -130.621803 mm, Z = 606.976606 mm,
      W = -179.217828 deg, P = -0.061558 deg, R = -61.494480 deg
};
P[247] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 354.376499 mm, Y = -129.977519 mm, Z = 606.743986 mm,
      W = -179.373334 deg, P = -0.039426 deg, R = -61.613119 deg
};
P[248] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 351.420377 mm, Y = -129.424821 mm, Z = 606.560883 mm,
      W = -179.529458 deg, P = -0.022190 deg, R = -61.730125 deg
};
P[249] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 348.441307 mm, Y = -128.964696 mm, Z = 606.428921 mm,
      W = -179.686047 deg, P = -0.009866 deg, R = -61.845471 deg
};
P[250] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 345.442193 mm, Y = -128.598039 mm, Z = 606.349273 mm,
      W = -179.842946 deg, P = -0.002467 deg, R = -61.959128 deg
};
P[251] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 342.425975 mm, Y = -128.325656 mm, Z = 606.322645 mm,
      W = -180.000000 deg, P = -0.000000 deg, R = -62.071068 deg
};
P[252] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 339.395622 mm, Y = -128.148261 mm, Z = 606.349273 mm,
      W = -180.157054 deg, P = -0.002467 deg, R = -62.181263 deg
};
P[253] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 336.354132 mm, Y = -128.066471 mm, Z = 606.428921 mm,
      W = -180.313953 deg, P = -0.009866 deg, R = -62.289686 deg
};
P[254] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 333.304527 mm, Y = -128.080813 mm, Z = 606.560883 mm,
      W = -180.470542 deg, P = -0.022190 deg, R = -62.396311 deg
};
P[255] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 330.249851 mm, Y = -128.191713 mm, Z = 606.743986 mm,
      W = -180.626666 deg, P = -0.039426 deg, R = -62.501111 deg
};
P[256] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 327.193169 mm, Y = -128.399504 mm, Z = 606.976606 mm,
      W = -180.782172 deg, P = -0.061558 deg, R = -62.604060 deg
};
P[257] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 324.137558 mm, Y = -128.704420 mm, Z = 607.256677 mm,
      W = -180.936907 deg, P = -0.088564 deg, R = -62.705132 deg
};
P[258] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 321.086112 mm, Y = -129.106599 mm, Z = 607.581715 mm,
      W = -181.090716 deg, P = -0.120416 deg, R = -62.804304 deg
};
P[259] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 318.041931 mm, Y = -129.606077 mm, Z = 607.948833 mm,
      W = -181.243449 deg, P = -0.157084 deg, R = -62.901550 deg
};
P[260] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 315.008124 mm, Y = -130.202794 mm, Z = 608.354774 mm,
      W = -181.394956 deg, P = -0.198532 deg, R = -62.996847 deg
};
P[261] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 311.987801 mm, Y = -130.896589 mm, Z = 608.795933 mm,
      W = -181.545085 deg, P = -0.244717 deg, R = -63.090170 deg
};
P[262] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 308.984074 mm, Y = -131.687202 mm, Z = 609.268396 mm,
      W = -181.693690 deg, P = -0.295596 deg, R = -63.181497 deg
};
P[263] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 306.000050 mm, Y = -132.574273 mm, Z = 609.767969 mm,
      W = -181.840623 deg, P = -0.351118 deg, R = -63.270806 deg
};
P[264] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 303.038833 mm, Y = -133.557341 mm, Z = 610.290217 mm,
      W = -181.985739 deg, P = -0.411227 deg, R = -63.358074 deg
};
P[265] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 300.103513 mm, Y = -134.635847 mm, Z = 610.830505 mm,
      W = -182.128896 deg, P = -0.475865 deg, R = -63.443279 deg
};
P[266] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 297.197171 mm, Y = -135.809131 mm, Z = 611.384038 mm,
      W = -182.269952 deg, P = -0.544967 deg, R = -63.526402 deg
};
P[267] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 294.322870 mm, Y = -137.076434 mm, Z = 611.945902 mm,
      W = -182.408768 deg, P = -0.618467 deg, R = -63.607420 deg
};
P[268] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 291.483655 mm, Y = -138.436898 mm, Z = 612.511109 mm,
      W = -182.545207 deg, P = -0.696290 deg, R = -63.686315 deg
};
P[269] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 288.682547 mm, Y = -139.889565 mm, Z = 613.074644 mm,
      W = -182.679134 deg, P = -0.778360 deg, R = -63.763067 deg
};
P[270] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 285.922543 mm, Y = -141.433381 mm, Z = 613.631504 mm,
      W = -182.810417 deg, P = -0.864597 deg, R = -63.837656 deg
};
P[271] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 283.206611 mm, Y = -143.067194 mm, Z = 614.176747 mm,
      W = -182.938926 deg, P = -0.954915 deg, R = -63.910065 deg
};
P[272] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.537685 mm, Y = -144.789754 mm, Z = 614.705532 mm,
      W = -183.064535 deg, P = -1.049225 deg, R = -63.980276 deg
};
P[273] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 277.918667 mm, Y = -146.599716 mm, Z = 615.213167 mm,
      W = -183.187120 deg, P = -1.147434 deg, R = -64.048271 deg
};
P[274] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 275.352419 mm, Y = -148.495641 mm, Z = 615.695145 mm,
      W = -183.306559 deg, P = -1.249445 deg, R = -64.114033 deg
};
P[275] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 272.841761 mm, Y = -150.475995 mm, Z = 616.147189 mm,
      W = -183.422736 deg, P = -1.355157 deg, R = -64.177546 deg
};
P[276] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 270.389471 mm, Y = -152.539153 mm, Z = 616.565285 mm,
      W = -183.535534 deg, P = -1.464466 deg, R = -64.238795 deg
};
P[277] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 267.998278 mm, Y = -154.683397 mm, Z = 616.945724 mm,
      W = -183.644843 deg, P = -1.577264 deg, R = -64.297765 deg
};
P[278] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 265.670860 mm, Y = -156.906919 mm, Z = 617.285128 mm,
      W = -183.750555 deg, P = -1.693441 deg, R = -64.354440 deg
};
P[279] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 263.409842 mm, Y = -159.207826 mm, Z = 617.580485 mm,
      W = -183.852566 deg, P = -1.812880 deg, R = -64.408808 deg
};
P[280] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 261.217793 mm, Y = -161.584134 mm, Z = 617.829173 mm,
      W = -183.950775 deg, P = -1.935465 deg, R = -64.460854 deg
};
P[281] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 259.097224 mm, Y = -164.033775 mm, Z = 618.028984 mm,
      W = -184.045085 deg, P = -2.061074 deg, R = -64.510565 deg
};
P[282] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 257.050582 mm, Y = -166.554599 mm, Z = 618.178145 mm,
      W = -184.135403 deg, P = -2.189583 deg, R = -64.557930 deg
};
P[283] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 255.080251 mm, Y = -169.144374 mm, Z = 618.275333 mm,
      W = -184.221640 deg, P = -2.320866 deg, R = -64.602937 deg
};
P[284] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 253.188545 mm, Y = -171.800787 mm, Z = 618.319684 mm,
      W = -184.303710 deg, P = -2.454793 deg, R = -64.645574 deg
};
P[285] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 251.377711 mm, Y = -174.521449 mm, Z = 618.310805 mm,
      W = -184.381533 deg, P = -2.591232 deg, R = -64.685832 deg
};
P[286] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 249.649920 mm, Y = -177.303895 mm, Z = 618.248775 mm,
      W = -184.455033 deg, P = -2.730048 deg, R = -64.723699 deg
};
P[287] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 248.007272 mm, Y = -180.145587 mm, Z = 618.134144 mm,
      W = -184.524135 deg, P = -2.871104 deg, R = -64.759168 deg
};
P[288] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 246.451785 mm, Y = -183.043915 mm, Z = 617.967929 mm,
      W = -184.588773 deg, P = -3.014261 deg, R = -64.792228 deg
};
P[289] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 244.985399 mm, Y = -185.996203 mm, Z = 617.751607 mm,
      W = -184.648882 deg, P = -3.159377 deg, R = -64.822873 deg
};
P[290] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 243.609972 mm, Y = -188.999706 mm, Z = 617.487097 mm,
      W = -184.704404 deg, P = -3.306310 deg, R = -64.851093 deg
};
P[291] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 242.327276 mm, Y = -192.051617 mm, Z = 617.176747 mm,
      W = -184.755283 deg, P = -3.454915 deg, R = -64.876883 deg
};
P[292] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 241.138998 mm, Y = -195.149069 mm, Z = 616.823311 mm,
      W = -184.801468 deg, P = -3.605044 deg, R = -64.900237 deg
};
P[293] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 240.046735 mm, Y = -198.289135 mm, Z = 616.429927 mm,
      W = -184.842916 deg, P = -3.756551 deg, R = -64.921147 deg
};
P[294] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 239.051992 mm, Y = -201.468833 mm, Z = 616.000087 mm,
      W = -184.879584 deg, P = -3.909284 deg, R = -64.939610 deg
};
P[295] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 238.156183 mm, Y = -204.685130 mm, Z = 615.537606 mm,
      W = -184.911436 deg, P = -4.063093 deg, R = -64.955620 deg
};
P[296] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 237.360628 mm, Y = -207.934940 mm, Z = 615.046588 mm,
      W = -184.938442 deg, P = -4.217828 deg, R = -64.969173 deg
};
P[297] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 236.666548 mm, Y = -211.215133 mm, Z = 614.531392 mm,
      W = -184.960574 deg, P = -4.373334 deg, R = -64.980267 deg
};
P[298] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 236.075068 mm, Y = -214.522536 mm, Z = 613.996591 mm,
      W = -184.977810 deg, P = -4.529458 deg, R = -64.988899 deg
};
P[299] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 235.587213 mm, Y = -217.853931 mm, Z = 613.446933 mm,
      W = -184.990134 deg, P = -4.686047 deg, R = -64.995066 deg
};
P[300] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 235.203909 mm, Y = -221.206067 mm, Z = 612.887295 mm,
      W = -184.997533 deg, P = -4.842946 deg, R = -64.998766 deg
};
P[301] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 234.925975 mm, Y = -224.575656 mm, Z = 612.322645 mm,
      W = -185.000000 deg, P = -5.000000 deg, R = -65.000000 deg
};
P[302] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 234.754131 mm, Y = -227.959380 mm, Z = 611.757995 mm,
      W = -184.997533 deg, P = -5.157054 deg, R = -64.998766 deg
};
P[303] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 234.688989 mm, Y = -231.353893 mm, Z = 611.198357 mm,
      W = -184.990134 deg, P = -5.313953 deg, R = -64.995066 deg
};
P[304] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 234.731059 mm, Y = -234.755823 mm, Z = 610.648698 mm,
      W = -184.977810 deg, P = -5.470542 deg, R = -64.988899 deg
};
P[305] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 234.880741 mm, Y = -238.161779 mm, Z = 610.113897 mm,
      W = -184.960574 deg, P = -5.626666 deg, R = -64.980267 deg
};
P[306] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 235.138329 mm, Y = -241.568350 mm, Z = 609.598702 mm,
      W = -184.938442 deg, P = -5.782172 deg, R = -64.969173 deg
};
P[307] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 235.504008 mm, Y = -244.972112 mm, Z = 609.107684 mm,
      W = -184.911436 deg, P = -5.936907 deg, R = -64.955620 deg
};
P[308] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 235.977854 mm, Y = -248.369630 mm, Z = 608.645202 mm,
      W = -184.879584 deg, P = -6.090716 deg, R = -64.939610 deg
};
P[309] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 236.559835 mm, Y = -251.757461 mm, Z = 608.215362 mm,
      W = -184.842916 deg, P = -6.243449 deg, R = -64.921147 deg
};
P[310] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 237.249809 mm, Y = -255.132157 mm, Z = 607.821978 mm,
      W = -184.801468 deg, P = -6.394956 deg, R = -64.900237 deg
};
P[311] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 238.047522 mm, Y = -258.490271 mm, Z = 607.468543 mm,
      W = -184.755283 deg, P = -6.545085 deg, R = -64.876883 deg
};
P[312] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 238.952612 mm, Y = -261.828359 mm, Z = 607.158193 mm,
      W = -184.704404 deg, P = -6.693690 deg, R = -64.851093 deg
};
P[313] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 239.964606 mm, Y = -265.142982 mm, Z = 606.893682 mm,
      W = -184.648882 deg, P = -6.840623 deg, R = -64.822873 deg
};
P[314] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 241.082920 mm, Y = -268.430712 mm, Z = 606.677360 mm,
      W = -184.588773 deg, P = -6.985739 deg, R = -64.792228 deg
};
P[315] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 242.306861 mm, Y = -271.688135 mm, Z = 606.511146 mm,
      W = -184.524135 deg, P = -7.128896 deg, R = -64.759168 deg
};
P[316] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 243.635626 mm, Y = -274.911853 mm, Z = 606.396515 mm,
      W = -184.455033 deg, P = -7.269952 deg, R = -64.723699 deg
};
P[317] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 245.068303 mm, Y = -278.098489 mm, Z = 606.334484 mm,
      W = -184.381533 deg, P = -7.408768 deg, R = -64.685832 deg
};
P[318] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 246.603869 mm, Y = -281.244692 mm, Z = 606.325605 mm,
      W = -184.303710 deg, P = -7.545207 deg, R = -64.645574 deg
};
P[319] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 248.241195 mm, Y = -284.347135 mm, Z = 606.369957 mm,
      W = -184.221640 deg, P = -7.679134 deg, R = -64.602937 deg
};
P[320] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 249.979044 mm, Y = -287.402526 mm, Z = 606.467144 mm,
      W = -184.135403 deg, P = -7.810417 deg, R = -64.557930 deg
};
P[321] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 251.816071 mm, Y = -290.407604 mm, Z = 606.616306 mm,
      W = -184.045085 deg, P = -7.938926 deg, R = -64.510565 deg
};
P[322] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 253.750829 mm, Y = -293.359150 mm, Z = 606.816117 mm,
      W = -183.950775 deg, P = -8.064535 deg, R = -64.460854 deg
};
P[323] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 255.781761 mm, Y = -296.253984 mm, Z = 607.064805 mm,
      W = -183.852566 deg, P = -8.187120 deg, R = -64.408808 deg
};
P[324] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 257.907210 mm, Y = -299.088971 mm, Z = 607.360161 mm,
      W = -183.750555 deg, P = -8.306559 deg, R = -64.354440 deg
};
P[325] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 260.125417 mm, Y = -301.861024 mm, Z = 607.699565 mm,
      W = -183.644843 deg, P = -8.422736 deg, R = -64.297765 deg
};
P[326] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 262.434520 mm, Y = -304.567111 mm, Z = 608.080004 mm,
      W = -183.535534 deg, P = -8.535534 deg, R = -64.238795 deg
};
P[327] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 264.832560 mm, Y = -307.204250 mm, Z = 608.498101 mm,
      W = -183.422736 deg, P = -8.644843 deg, R = -64.177546 deg
};
P[328] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 267.317480 mm, Y = -309.769521 mm, Z = 608.950144 mm,
      W = -183.306559 deg, P = -8.750555 deg, R = -64.114033 deg
};
P[329] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 269.887125 mm, Y = -312.260063 mm, Z = 609.432123 mm,
      W = -183.187120 deg, P = -8.852566 deg, R = -64.048271 deg
};
P[330] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 272.539248 mm, Y = -314.673081 mm, Z = 609.939757 mm,
      W = -183.064535 deg, P = -8.950775 deg, R = -63.980276 deg
};
P[331] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 275.271510 mm, Y = -317.005848 mm, Z = 610.468543 mm,
      W = -182.938926 deg, P = -9.045085 deg, R = -63.910065 deg
};
P[332] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 278.081480 mm, Y = -319.255705 mm, Z = 611.013785 mm,
      W = -182.810417 deg, P = -9.135403 deg, R = -63.837656 deg
};
P[333] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 280.966641 mm, Y = -321.420069 mm, Z = 611.570645 mm,
      W = -182.679134 deg, P = -9.221640 deg, R = -63.763067 deg
};
P[334] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 283.924390 mm, Y = -323.496434 mm, Z = 612.134180 mm,
      W = -182.545207 deg, P = -9.303710 deg, R = -63.686315 deg
};
P[335] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 286.952039 mm, Y = -325.482370 mm, Z = 612.699388 mm,
      W = -182.408768 deg, P = -9.381533 deg, R = -63.607420 deg
};
P[336] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 290.046821 mm, Y = -327.375534 mm, Z = 613.261252 mm,
      W = -182.269952 deg, P = -9.455033 deg, R = -63.526402 deg
};
P[337] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 293.205889 mm, Y = -329.173663 mm, Z = 613.814784 mm,
      W = -182.128896 deg, P = -9.524135 deg, R = -63.443279 deg
};
P[338] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 296.426320 mm, Y = -330.874586 mm, Z = 614.355072 mm,
      W = -181.985739 deg, P = -9.588773 deg, R = -63.358074 deg
};
P[339] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 299.705120 mm, Y = -332.476217 mm, Z = 614.877321 mm,
      W = -181.840623 deg, P = -9.648882 deg, R = -63.270806 deg
};
P[340] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 303.039223 mm, Y = -333.976568 mm, Z = 615.376893 mm,
      W = -181.693690 deg, P = -9.704404 deg, R = -63.181497 deg
};
P[341] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 306.425495 mm, Y = -335.373740 mm, Z = 615.849356 mm,
      W = -181.545085 deg, P = -9.755283 deg, R = -63.090170 deg
};
P[342] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 309.860738 mm, Y = -336.665937 mm, Z = 616.290516 mm,
      W = -181.394956 deg, P = -9.801468 deg, R = -62.996847 deg
};
P[343] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 313.341692 mm, Y = -337.851457 mm, Z = 616.696457 mm,
      W = -181.243449 deg, P = -9.842916 deg, R = -62.901550 deg
};
P[344] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 316.865040 mm, Y = -338.928703 mm, Z = 617.063575 mm,
      W = -181.090716 deg, P = -9.879584 deg, R = -62.804304 deg
};
P[345] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 320.427408 mm, Y = -339.896179 mm, Z = 617.388612 mm,
      W = -180.936907 deg, P = -9.911436 deg, R = -62.705132 deg
};
P[346] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 324.025371 mm, Y = -340.752497 mm, Z = 617.668684 mm,
      W = -180.782172 deg, P = -9.938442 deg, R = -62.604060 deg
};
P[347] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 327.655453 mm, Y = -341.496374 mm, Z = 617.901304 mm,
      W = -180.626666 deg, P = -9.960574 deg, R = -62.501111 deg
};
P[348] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 331.314136 mm, Y = -342.126635 mm, Z = 618.084407 mm,
      W = -180.470542 deg, P = -9.977810 deg, R = -62.396311 deg
};
P[349] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 334.997856 mm, Y = -342.642218 mm, Z = 618.216368 mm,
      W = -180.313953 deg, P = -9.990134 deg, R = -62.289686 deg
};
P[350] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 338.703015 mm, Y = -343.042171 mm, Z = 618.296017 mm,
      W = -180.157054 deg, P = -9.997533 deg, R = -62.181263 deg
};
P[351] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 342.425975 mm, Y = -343.325656 mm, Z = 618.322645 mm,
      W = -180.000000 deg, P = -10.000000 deg, R = -62.071068 deg
};
P[352] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 346.163070 mm, Y = -343.491949 mm, Z = 618.296017 mm,
      W = -179.842946 deg, P = -9.997533 deg, R = -61.959128 deg
};
P[353] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 349.910605 mm, Y = -343.540442 mm, Z = 618.216368 mm,
      W = -179.686047 deg, P = -9.990134 deg, R = -61.845471 deg
};
P[354] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 353.664860 mm, Y = -343.470644 mm, Z = 618.084407 mm,
      W = -179.529458 deg, P = -9.977810 deg, R = -61.730125 deg
};
P[355] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 357.422096 mm, Y = -343.282180 mm, Z = 617.901304 mm,
      W = -179.373334 deg, P = -9.960574 deg, R = -61.613119 deg
};
P[356] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 361.178556 mm, Y = -342.974796 mm, Z = 617.668684 mm,
      W = -179.217828 deg, P = -9.938442 deg, R = -61.494480 deg
};
P[357] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 364.930471 mm, Y = -342.548355 mm, Z = 617.388612 mm,
      W = -179.063093 deg, P = -9.911436 deg, R = -61.374240 deg
};
P[358] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 368.674060 mm, Y = -342.002840 mm, Z = 617.063575 mm,
      W = -178.909284 deg, P = -9.879584 deg, R = -61.252427 deg
};
P[359] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 372.405541 mm, Y = -341.338356 mm, Z = 616.696457 mm,
      W = -178.756551 deg, P = -9.842916 deg, R = -61.129071 deg
};
P[360] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 376.121126 mm, Y = -340.555126 mm, Z = 616.290516 mm,
      W = -178.605044 deg, P = -9.801468 deg, R = -61.004202 deg
};
P[361] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 379.817031 mm, Y = -339.653495 mm, Z = 615.849356 mm,
      W = -178.454915 deg, P = -9.755283 deg, R = -60.877853 deg
};
P[362] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 383.489479 mm, Y = -338.633927 mm, Z = 615.376893 mm,
      W = -178.306310 deg, P = -9.704404 deg, R = -60.750053 deg
};
P[363] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 387.134702 mm, Y = -337.497010 mm, Z = 614.877321 mm,
      W = -178.159377 deg, P = -9.648882 deg, R = -60.620834 deg
};
P[364] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 390.748944 mm, Y = -336.243450 mm, Z = 614.355072 mm,
      W = -178.014261 deg, P = -9.588773 deg, R = -60.490228 deg
};
P[365] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 394.328470 mm, Y = -334.874074 mm, Z = 613.814784 mm,
      W = -177.871104 deg, P = -9.524135 deg, R = -60.358268 deg
};
P[366] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 397.869565 mm, Y = -333.389828 mm, Z = 613.261252 mm,
      W = -177.730048 deg, P = -9.455033 deg, R = -60.224986 deg
};
P[367] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 401.368537 mm, Y = -331.791778 mm, Z = 612.699388 mm,
      W = -177.591232 deg, P = -9.381533 deg, R = -60.090414 deg
};
P[368] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 404.821726 mm, Y = -330.081110 mm, Z = 612.134180 mm,
      W = -177.454793 deg, P = -9.303710 deg, R = -59.954587 deg
};
P[369] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 408.225505 mm, Y = -328.259125 mm, Z = 611.570645 mm,
      W = -177.320866 deg, P = -9.221640 deg, R = -59.817537 deg
};
P[370] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 411.576282 mm, Y = -326.327244 mm, Z = 611.013785 mm,
      W = -177.189583 deg, P = -9.135403 deg, R = -59.679298 deg
};
P[371] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 414.870507 mm, Y = -324.287001 mm, Z = 610.468543 mm,
      W = -177.061074 deg, P = -9.045085 deg, R = -59.539905 deg
};
P[372] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 418.104673 mm, Y = -322.140046 mm, Z = 609.939757 mm,
      W = -176.935465 deg, P = -8.950775 deg, R = -59.399392 deg
};
P[373] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 421.275322 mm, Y = -319.888144 mm, Z = 609.432123 mm,
      W = -176.812880 deg, P = -8.852566 deg, R = -59.257793 deg
};
P[374] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 424.379048 mm, Y = -317.533170 mm, Z = 608.950144 mm,
      W = -176.693441 deg, P = -8.750555 deg, R = -59.115144 deg
};
P[375] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 427.412498 mm, Y = -315.077111 mm, Z = 608.498101 mm,
      W = -176.577264 deg, P = -8.644843 deg, R = -58.971479 deg
};
P[376] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 430.372381 mm, Y = -312.522062 mm, Z = 608.080004 mm,
      W = -176.464466 deg, P = -8.535534 deg, R = -58.826834 deg
};
P[377] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 433.255466 mm, Y = -309.870225 mm, Z = 607.699565 mm,
      W = -176.355157 deg, P = -8.422736 deg, R = -58.681246 deg
};
P[378] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 436.058589 mm, Y = -307.123910 mm, Z = 607.360161 mm,
      W = -176.249445 deg, P = -8.306559 deg, R = -58.534748 deg
};
P[379] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 438.778656 mm, Y = -304.285526 mm, Z = 607.064805 mm,
      W = -176.147434 deg, P = -8.187120 deg, R = -58.387379 deg
};
P[380] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 441.412644 mm, Y = -301.357587 mm, Z = 606.816117 mm,
      W = -176.049225 deg, P = -8.064535 deg, R = -58.239174 deg
};
P[381] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 443.957608 mm, Y = -298.342705 mm, Z = 606.616306 mm,
      W = -175.954915 deg, P = -7.938926 deg, R = -58.090170 deg
};
P[382] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 446.410680 mm, Y = -295.243589 mm, Z = 606.467144 mm,
      W = -175.864597 deg, P = -7.810417 deg, R = -57.940403 deg
};
P[383] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 448.769077 mm, Y = -292.063041 mm, Z = 606.369957 mm,
      W = -175.778360 deg, P = -7.679134 deg, R = -57.789911 deg
};
P[384] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 451.030100 mm, Y = -288.803957 mm, Z = 606.325605 mm,
      W = -175.696290 deg, P = -7.545207 deg, R = -57.638730 deg
};
P[385] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 453.191139 mm, Y = -285.469320 mm, Z = 606.334484 mm,
      W = -175.618467 deg, P = -7.408768 deg, R = -57.486899 deg
};
P[386] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 455.249676 mm, Y = -282.062203 mm, Z = 606.396515 mm,
      W = -175.544967 deg, P = -7.269952 deg, R = -57.334454 deg
};
P[387] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 457.203286 mm, Y = -278.585759 mm, Z = 606.511146 mm,
      W = -175.475865 deg, P = -7.128896 deg, R = -57.181432 deg
};
P[388] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 459.049644 mm, Y = -275.043224 mm, Z = 606.677360 mm,
      W = -175.411227 deg, P = -6.985739 deg, R = -57.027873 deg
};
P[389] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 460.786521 mm, Y = -271.437912 mm, Z = 606.893682 mm,
      W = -175.351118 deg, P = -6.840623 deg, R = -56.873813 deg
};
P[390] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 462.411795 mm, Y = -267.773209 mm, Z = 607.158193 mm,
      W = -175.295596 deg, P = -6.693690 deg, R = -56.719291 deg
};
P[391] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 463.923445 mm, Y = -264.052577 mm, Z = 607.468543 mm,
      W = -175.244717 deg, P = -6.545085 deg, R = -56.564345 deg
};
P[392] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 465.319559 mm, Y = -260.279543 mm, Z = 607.821978 mm,
      W = -175.198532 deg, P = -6.394956 deg, R = -56.409012 deg
};
P[393] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 466.598336 mm, Y = -256.457700 mm, Z = 608.215362 mm,
      W = -175.157084 deg, P = -6.243449 deg, R = -56.253332 deg
};
P[394] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 467.758085 mm, Y = -252.590702 mm, Z = 608.645202 mm,
      W = -175.120416 deg, P = -6.090716 deg, R = -56.097343 deg
};
P[395] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 468.797230 mm, Y = -248.682262 mm, Z = 609.107684 mm,
      W = -175.088564 deg, P = -5.936907 deg, R = -55.941083 deg
};
P[396] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 469.714310 mm, Y = -244.736148 mm, Z = 609.598702 mm,
      W = -175.061558 deg, P = -5.782172 deg, R = -55.784591 deg
};
P[397] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 470.507983 mm, Y = -240.756177 mm, Z = 610.113897 mm,
      W = -175.039426 deg, P = -5.626666 deg, R = -55.627905 deg
};
P[398] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 471.177026 mm, Y = -236.746214 mm, Z = 610.648698 mm,
      W = -175.022190 deg, P = -5.470542 deg, R = -55.471065 deg
};
P[399] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 471.720337 mm, Y = -232.710168 mm, Z = 611.198357 mm,
      W = -175.009866 deg, P = -5.313953 deg, R = -55.314108 deg
};
P[400] {
   GP1:
       UF : 3, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 472.136939 mm, Y = -228.651987 mm, Z = 611.757995 mm,
      W = -175.002467 deg, P = -5.157054 deg, R = -55.157073 deg
};
P[401] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 142.358644 mm, Y = 313.070928 mm, Z = 702.449726 mm,
      W = 179.794466 deg, P = -3.312447 deg, R = 55.004425 deg
};
P[402] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 154.358644 mm, Y = 304.070928 mm, Z = 672.449726 mm,
      W = 180.794466 deg, P = -4.312447 deg, R = 57.004425 deg
};
P[403] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 166.358644 mm, Y = 295.070928 mm, Z = 702.449726 mm,
      W = 181.794466 deg, P = -5.312447 deg, R = 59.004425 deg
};
P[404] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 178.358644 mm, Y = 286.070928 mm, Z = 672.449726 mm,
      W = 182.794466 deg, P = -6.312447 deg, R = 61.004425 deg
};
P[405] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 190.358644 mm, Y = 277.070928 mm, Z = 702.449726 mm,
      W = 183.794466 deg, P = -7.312447 deg, R = 63.004425 deg
};
P[406] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 202.358644 mm, Y = 268.070928 mm, Z = 672.449726 mm,
      W = 184.794466 deg, P = -8.312447 deg, R = 65.004425 deg
};
P[407] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 214.358644 mm, Y = 259.070928 mm, Z = 702.449726 mm,
      W = 185.794466 deg, P = -9.312447 deg, R = 67.004425 deg
};
P[408] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 226.358644 mm, Y = 250.070928 mm, Z = 672.449726 mm,
      W = 186.794466 deg, P = -10.312447 deg, R = 69.004425 deg
};
P[409] {
   GP1:
       UF : 4, UT : 3,     CONFIG: 'N U T, 0, 0, 0',
      X = 238.358644 mm, Y = 241.070928 mm, Z = 702.449726 mm,
      W = 187.794466 deg, P = -11.312447 deg, R = 71.004425 deg
};
P[410] {
   GP1:
       UF : F, UT : F,     CONFIG: 'N U T, 0, 0, 0',
      X = 250.358644 mm, Y = 232.070928 mm, Z = 672.449726 mm,
      W = 188.794466 deg, P = -12.312447 deg, R = 73.004425 deg
};
/END